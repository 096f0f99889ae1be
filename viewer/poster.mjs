// node poster.mjs PAGE PICTURE [LOOK [WIDTH HEIGHT [SCALE]]]: a still picture of a page that `voussoir run --view` wrote, by
// headless Chromium. LOOK is the part after # in its address, e.g.
// "frame=3&magnified=100&colour=displacement&forces=arrows". The page draws it as its button `save PNG` does, or, if
// PICTURE ends in .webp, as lossless WebP, about 0.6 times as large. If it ends in .svg, PAGE is a report and LOOK names its
// figure, e.g. "figure=poles".
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';

const [page, picture, look = '', width = '920', height = '560', scale = '1'] = process.argv.slice(2);
if (!picture) {
  console.error('poster.mjs: name the page and the picture');
  process.exit(2);
}
const { error, stdout, stderr } = spawnSync('chromium', ['--headless=new', '--no-sandbox', '--disable-gpu-sandbox', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', `--force-device-scale-factor=${scale}`, '--virtual-time-budget=20000', '--dump-dom',
  `file://${encodeURI(resolve(page))}#${look}&poster=${width}x${height}${picture.endsWith('.webp') ? '.webp' : ''}`], { encoding: 'utf8', maxBuffer: 1 << 28 });
if (error?.code === 'ENOENT') {
  console.error('poster.mjs: chromium is not installed');
  process.exit(77);
}
const data = stdout?.match(/data-picture="data:image\/[\w+]+;base64,([^"]+)"/);
if (!data) {
  console.error(`poster.mjs: no picture: ${stderr.trim().split('\n').at(-1)}`);
  process.exit(1);
}
writeFileSync(picture, Buffer.from(data[1], 'base64'));
