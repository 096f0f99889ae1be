// node bundle_test.mjs COMMITTED MADE: the committed bundle is that of the present src/ and libraries, and so are their
// licences. Scripts are compared unpacked, because their packing depends on the version of node. Ends with 77 if it could not be
// made, which VOUSSOIR_NO_SKIP=1 makes a failure.
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';

const [committed, made] = process.argv.slice(2);
if (!statSync(join(made, 'asset.cpp'), { throwIfNoEntry: false })?.size) {
  console.log('not tested: npm or its registry is missing (viewer/modules/npm.log)');
  process.exit(process.env.VOUSSOIR_NO_SKIP === '1' ? 1 : 77);
}

// a bundle as the scripts that it packs and the text around them
function parts(folder) {
  const text = readFileSync(join(folder, 'asset.cpp'), 'utf8').replaceAll(/\)~~~"\s+R"~~~\(/g, '');
  const pieces = text.split(/(?<=class="voussoir-script" id="voussoir-[a-z]+">)([A-Za-z0-9+/=]+)(?=<)/);
  return { around: pieces.filter((_, k) => k % 2 === 0).join(''),
    scripts: pieces.filter((_, k) => k % 2 === 1).map((packed) => gunzipSync(Buffer.from(packed, 'base64')).toString('utf8')) };
}

const kept = parts(committed), now = parts(made);
const repair = "viewer/bundle differs from the bundle of viewer/src: run 'ninja -C build viewer_bundle' and commit it";
assert.equal(kept.scripts.length, 2, 'the committed bundle holds the viewer and the report');
for (const script of kept.scripts) assert.ok(script.length > 100000);
kept.scripts.forEach((script, k) => assert.ok(script === now.scripts[k], repair));
assert.ok(kept.around === now.around, repair);
assert.equal(readFileSync(join(committed, 'LICENSES'), 'utf8'), readFileSync(join(made, 'LICENSES'), 'utf8'), repair);
console.log(`the bundle is that of the sources: ${kept.scripts.map((script) => script.length).join(' and ')} bytes`);
