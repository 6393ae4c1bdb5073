// Formulas from standard input, {"formula", "display"} a line; their HTML to standard output, likewise.
const katex = require(process.argv[2]);
const lines = require('node:readline').createInterface({ input: process.stdin });
lines.on('line', (line) => {
  const { formula, display } = JSON.parse(line);
  let answer;
  try {
    answer = { html: katex.renderToString(formula, { displayMode: display, strict: 'error' }) };
  } catch (error) {
    answer = { error: error.message };
  }
  process.stdout.write(`${JSON.stringify(answer)}\n`);
});
