// node build.mjs MODULES ASSET: bundles src/ with three.js of MODULES and writes the parts of a page as a C++ file, and
// next to it the script as viewer.js, whose size is tested, and the licence of three.js.
import { createRequire } from 'node:module';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const [modules, asset] = process.argv.slice(2);
const source = join(dirname(fileURLToPath(import.meta.url)), 'src');
const esbuild = createRequire(join(modules, 'package.json'))('esbuild');

const bundle = esbuild.buildSync({
  entryPoints: [join(source, 'main.js')],
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: 'es2022',
  nodePaths: [join(modules, 'node_modules')],
  legalComments: 'inline',
  loader: { '.css': 'text' },
  charset: 'utf8',
});
const script = bundle.outputFiles[0].text;
writeFileSync(join(dirname(asset), 'viewer.js'), script);
copyFileSync(join(modules, 'node_modules/three/LICENSE'), join(dirname(asset), 'LICENSE.three'));
const packed = gzipSync(script, { level: 9 }).toString('base64');

// unpacks the script and runs it as an element's text: the policy below allows that, but no request
const loader = readFileSync(join(source, 'loader.js'), 'utf8').trim();
const policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:";
const pieces = {
  script: `<script type="text/plain" id="voussoir-viewer">${packed}</script>\n<script>${loader}</script>\n`,
  before_page: `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>Voussoir</title>
<style>html, body { height: 100%; margin: 0 } .voussoir { height: 100% }</style>
</head>
<body>
`,
  after_page: '</body>\n</html>\n',
  before_look: '<div class="voussoir" data-look="',
  before_poster: '"><img alt="blocks" src="data:image/',
  before_data: '"><script type="text/plain">',
  after_fragment: '</script></div>\n',
};

// compilers limit the length of a literal: its parts are joined
const literal = (text) =>
  (text.match(/[^]{1,8000}/g) ?? ['']).map((part) => `R"~~~(${part})~~~"`).join('\n    ');
const views = Object.entries(pieces).map(([name, text]) => `const std::string_view ${name} =\n    ${literal(text)};\n`);
writeFileSync(asset, `// Made by viewer/build.mjs of viewer/src and three.js; do not edit.
// clang-format off
#include "app/view/asset.hpp"

namespace voussoir::viewer {

${views.join('')}
}  // namespace voussoir::viewer
`);
console.log(`viewer.js ${script.length} bytes, ${packed.length} in a page`);
