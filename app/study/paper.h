// What the paper says of its four experiments, as data: Table 2, and its words on Figures 6 and 7.
// Of the figures only the words are known, so each is read as a share of a run between 0 and 1,
// with an interval in which the words leave it open.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace twinarm {

struct PaperRow {  // [deg], joints 1 and 2
  std::array<double, 2> max_deg, mean_deg;
  // Half of the last printed digit.
  std::array<double, 2> max_half_digit{0.05, 0.05}, mean_half_digit{0.05, 0.05};
};
// Of a row, measured or published: maxima, then means, of joints 1 and 2.
template <class Row>
std::array<double, 4> numbers_of(const Row& row) {
  return {row.max_deg[0], row.max_deg[1], row.mean_deg[0], row.mean_deg[1]};
}
// Table 2; "E4-text": what the text says of E4 instead.
inline const std::map<std::string, PaperRow> kPaperTable{
    {"E1", {{10.2, 26.3}, {1.6, 4.1}}},
    {"E2", {{1.7, 4.0}, {0.5, 0.5}}},
    {"E3", {{16.6, 23.5}, {8.6, 5.2}}},
    {"E4", {{3.4, 6.0}, {0.3, 0.6}}},
    {"E4-text", {{3.4, 4.0}, {0.34, 0.6}, {0.05, 0.05}, {0.005, 0.05}}}};

struct PaperStatement {
  const char* run;     // experiment
  const char* figure;  // of the paper
  const char* says;
  enum class Share {
    offset_of_joint2,  // of the error of joint 2, what keeps its sign within a sweep
    near_reversals     // mean error near changes of direction, over the sum of it and the rest's
  } share;
  const char* words;           // of the share
  double contradicts, agrees;  // up to, from
};
enum class Verdict { contradicts, open, agrees };
inline Verdict verdict_of(const PaperStatement& s, double share) {
  return share >= s.agrees        ? Verdict::agrees
         : share <= s.contradicts ? Verdict::contradicts
                                  : Verdict::open;
}
inline const char* verdict_words(Verdict v) {
  return v == Verdict::agrees ? "agrees" : v == Verdict::open ? "leaves it open" : "contradicts it";
}
inline const std::vector<PaperStatement> kPaperStatements{
    {"E3", "7c", "joint 2 has mainly an angular offset", PaperStatement::Share::offset_of_joint2,
     "share of its error that keeps its sign within a sweep: 1 for an offset, 0 for ringing", 0.3,
     0.7},
    {"E4", "7d", "almost overlapping, small errors at changes of direction only",
     PaperStatement::Share::near_reversals,
     "mean error within 0.25 s after a change of direction, over the sum of this and the other "
     "mean",
     0.5, 0.67},
    {"E1", "6a", "differences mainly where the direction changes",
     PaperStatement::Share::near_reversals, "as 7d", 0.5, 0.67},
    {"E2", "6b", "small errors at changes of direction only", PaperStatement::Share::near_reversals,
     "as 7d", 0.5, 0.67}};

}  // namespace twinarm
