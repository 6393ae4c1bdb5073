// Formulas of case statements, set as print does: letters that stand for quantities in italics,
// names of functions, words and numbers upright, roots with a bar. HTML in, HTML out; no script, no
// MathML, so that any browser and any printer shows them.
#pragma once

#include <string>
#include <string_view>

namespace twinarm::compare_page {

// A statement: text in which the formulas stand in <p>..</p>. They become
// <div class=formula>..</div>, each on its own; the text between becomes paragraphs.
std::string typeset_statement(std::string_view statement);
// What stands in one <p>.
std::string typeset_formula(std::string_view html);
// What a terminal shows as "mu", "rad/s^2" or "[m2]", in plain text and escaped: "μ", "rad/s²".
std::string typeset_words(std::string_view words);

}  // namespace twinarm::compare_page
