// node build.mjs MODULES ASSET: bundles src/ with three.js and Observable Plot of MODULES into two scripts, the viewer's
// and the report's, and writes the parts of a page as a C++ file, and next to it the scripts as viewer.js and report.js,
// whose sizes are tested, and LICENSES, those of all packages in them.
import { createRequire } from 'node:module';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const [modules, asset] = process.argv.slice(2);
const source = join(dirname(fileURLToPath(import.meta.url)), 'src');
const esbuild = createRequire(join(modules, 'package.json'))('esbuild');

const folders = new Set(); // of the packages that are bundled

// an entry of src/ with all that it imports, as an element of a page
function bundle(entry, name) {
  const made = esbuild.buildSync({
    entryPoints: [join(source, entry)],
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    absWorkingDir: modules,
    format: 'iife',
    target: 'es2022',
    nodePaths: [join(modules, 'node_modules')],
    legalComments: 'inline',
    loader: { '.css': 'text' },
    charset: 'utf8',
  });
  for (const file of Object.keys(made.metafile.inputs)) {
    const folder = file.match(/^(?:.*\/)?node_modules\/((?:@[^/]+\/)?[^/]+)\//)?.[1];
    if (folder) folders.add(folder);
  }
  const script = made.outputFiles[0].text, packed = gzipSync(script, { level: 9 }).toString('base64');
  writeFileSync(join(dirname(asset), name), script);
  console.log(`${name} ${script.length} bytes, ${packed.length} in a page`);
  return `<script type="text/plain" class="voussoir-script" id="voussoir-${name.replace('.js', '')}">${packed}</script>\n`;
}

// what a package says of its licence: its file, or if it has none the word in its description
function licenceOf(name) {
  const folder = join(modules, 'node_modules', name), file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  return `${name} ${version}\n\n${file ? readFileSync(join(folder, file), 'utf8').trim() : license}\n`;
}

// unpacks the script and runs it as an element's text: the policy below allows that, but no request
const loader = readFileSync(join(source, 'loader.js'), 'utf8').trim();
const policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:";
const start = (title) => `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>${title}</title>
`;
const pieces = {
  viewer_script: bundle('main.js', 'viewer.js'),
  report_script: bundle('report/page.js', 'report.js'),
  loading: `<script>${loader}</script>\n`,
  before_page: `${start('Voussoir')}<style>html, body { height: 100%; margin: 0 } .voussoir { height: 100% }</style>
</head>
<body>
`,
  after_page: '</body>\n</html>\n',
  before_report: `${start('Report')}</head>
<body>
<main></main>
<noscript>This page is drawn by its own script: open it in a browser that runs scripts.</noscript>
<script type="text/plain" id="voussoir-report">`,
  after_report_data: '</script>\n',
  before_blocks: '<template id="blocks">',
  after_blocks: '</template>\n',
  before_look: '<div class="voussoir" data-look="',
  before_poster: '"><img alt="blocks" src="data:image/',
  before_data: '"><script type="text/plain">',
  after_fragment: '</script></div>\n',
};

// compilers limit the length of a literal: its parts are joined
const literal = (text) =>
  (text.match(/[^]{1,8000}/g) ?? ['']).map((part) => `R"~~~(${part})~~~"`).join('\n    ');
const views = Object.entries(pieces).map(([name, text]) => `const std::string_view ${name} =\n    ${literal(text)};\n`);
writeFileSync(asset, `// Made by viewer/build.mjs of viewer/src, three.js and Observable Plot; do not edit.
// clang-format off
#include "app/view/asset.hpp"

namespace voussoir::viewer {

${views.join('')}
}  // namespace voussoir::viewer
`);
writeFileSync(join(dirname(asset), 'LICENSES'), [...folders].sort().map(licenceOf).join(`\n${'-'.repeat(80)}\n\n`));
