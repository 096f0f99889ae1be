// Corners of blocks in a frame that was written for ParaView, by body: an output of the state that shares no code with
// the viewer's.
import { readFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';

const opening = '<AppendedData encoding="raw">\n_';

export function cornersByBody(file) {
  const bytes = readFileSync(file), begin = bytes.indexOf(opening), text = bytes.toString('utf8', 0, begin);
  const data = bytes.subarray(begin + opening.length);
  const array = (name, section, Numbers) => {
    const [, at] = text.slice(text.indexOf(`<${section}>`)).match(new RegExp(`Name="${name}"[^>]*offset="(\\d+)"`));
    const size = Number(data.readBigUInt64LE(Number(at) + 24));  // the last word of the header
    const plain = inflateSync(data.subarray(Number(at) + 32, Number(at) + 32 + size));
    return [...new Numbers(Uint8Array.from(plain).buffer)].map(Number);
  };
  const points = array('Points', 'Points', Float64Array), body = array('body', 'CellData', BigInt64Array);
  const places = array('connectivity', 'Polys', BigInt64Array), ends = array('offsets', 'Polys', BigInt64Array);
  const corners = new Map();
  body.forEach((b, cell) => {
    for (const place of places.slice(cell ? ends[cell - 1] : 0, ends[cell])) {
      if (!corners.has(b)) corners.set(b, new Set());
      corners.get(b).add(place);
    }
  });
  const at = (place) => points.slice(3 * place, 3 * place + 3);
  return new Map([...corners].map(([b, list]) => [b, [...list].sort((x, y) => x - y).map(at)]));
}
