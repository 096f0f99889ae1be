// node bundle_test.mjs COMMITTED MADE: the committed bundle is that of the present src/ and three.js, and so is the licence.
// The script is compared unpacked, because its packing depends on the version of node. Ends with 77 if it could not be
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

// a bundle as the script it packs and the text around it
function parts(folder) {
  const text = readFileSync(join(folder, 'asset.cpp'), 'utf8').replaceAll(/\)~~~"\s+R"~~~\(/g, '');
  const [before, packed, after] = text.split(/(?<=id="voussoir-viewer">)([A-Za-z0-9+/=]+)(?=<)/);
  return { around: before + after, script: gunzipSync(Buffer.from(packed, 'base64')).toString('utf8') };
}

const kept = parts(committed), now = parts(made);
const repair = "viewer/bundle differs from the bundle of viewer/src: run 'ninja -C build viewer_bundle' and commit it";
assert.ok(kept.script.length > 100000, 'the committed bundle holds a script');
assert.ok(kept.script === now.script, repair);
assert.ok(kept.around === now.around, repair);
assert.equal(readFileSync(join(committed, 'LICENSE.three'), 'utf8'), readFileSync(join(made, 'LICENSE.three'), 'utf8'), repair);
console.log(`the bundle is that of the sources: ${kept.script.length} bytes`);
