// Bundles the pages: node build.mjs FOLDER_OF_MODULES BUNDLE.cpp. Writes a C++ file with the
// templates of web_bundle.h; @TITLE@, @RUN@ and @BYTES@ are left for the program to fill in.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [modules, out] = process.argv.slice(2);
const esbuild = createRequire(pathToFileURL(join(modules, 'any.js')))('esbuild');

async function bundle(name) {
  const built = await esbuild.build({
    entryPoints: [join(here, 'src', 'pages', `${name}.ts`)],
    outfile: `${name}.js`,
    nodePaths: [modules],
    bundle: true,
    write: false,
    minify: true,
    format: 'iife',
    target: 'es2021',
    charset: 'utf8',
    legalComments: 'eof',
  });
  const text = (end) => built.outputFiles.find((file) => file.path.endsWith(end)).text;
  return { script: text('.js'), style: text('.css') };
}

// What is in the bundle, and on which terms: all of them ask for their text to be kept.
function licences() {
  return ['three', 'uplot']
    .map((name) => {
      const { version, license } = JSON.parse(
        readFileSync(join(modules, name, 'package.json'), 'utf8'),
      );
      const text = readFileSync(join(modules, name, 'LICENSE'), 'utf8');
      return `${name} ${version} (${license})\n\n${text.trim()}\n`;
    })
    .join('\n\n');
}

const inScript = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const form = readFileSync(join(here, 'page.html'), 'utf8');
const POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:";
// A page that carries its data, or one that asks the program for it.
const CARRIES = {
  POLICY,
  DATA: `<script type="application/json" id="run">@RUN@</script>
<script type="text/plain" id="run-bytes">@BYTES@</script>`,
};
const ASKS = { POLICY: `${POLICY} blob: 'self'; connect-src 'self'`, TITLE: 'twinarm lab', DATA: '' };
async function page(name, own) {
  const { script, style } = await bundle(name);
  const parts = { STYLE: style, LICENCES: licences(), SCRIPT: inScript(script), ...own };
  return form.replace(/@([A-Z]+)@/g, (mark, part) => parts[part]?.trim() ?? mark);
}
const raw = async (name, own) => `R"=twinarm=(${await page(name, own)})=twinarm="`;
writeFileSync(
  out,
  `// Made by app/web/build.mjs.
#include "app/web/web_bundle.h"

#pragma GCC diagnostic ignored "-Woverlength-strings"

namespace twinarm {
WebBundle web_bundle() {
  return {${await raw('replay', CARRIES)},
          ${await raw('inspect', CARRIES)},
          ${await raw('lab', ASKS)}, ""};
}
}  // namespace twinarm
`,
);
