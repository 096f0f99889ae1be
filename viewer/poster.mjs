// node poster.mjs PAGE PNG [LOOK [WIDTH HEIGHT]]: a still picture of a page that `voussoir run --view` wrote, by headless
// Chromium. LOOK is what stands behind # in its address, e.g. "frame=3&magnified=100&colour=displacement&forces=arrows".
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { resolve } from 'node:path';

const [page, png, look = '', width = '920', height = '560'] = process.argv.slice(2);
if (!png) {
  console.error('poster.mjs: name the page and the PNG');
  process.exit(2);
}
const { error, stderr } = spawnSync('chromium', ['--headless=new', '--no-sandbox', '--disable-gpu-sandbox', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader', '--hide-scrollbars', '--force-device-scale-factor=1', '--virtual-time-budget=10000',
  `--window-size=${width},${height}`, `--screenshot=${resolve(png)}`, `file://${encodeURI(resolve(page))}#panel=0&${look}`], { encoding: 'utf8' });
if (error?.code === 'ENOENT') {
  console.error('poster.mjs: chromium is not installed');
  process.exit(77);
}
if (!existsSync(png)) {
  console.error(`poster.mjs: no picture: ${stderr.trim().split('\n').at(-1)}`);
  process.exit(1);
}
