// Corners of blocks in a frame that was written for ParaView, by body: an output of the state that shares no code with
// the viewer's.
import { readFileSync } from 'node:fs';

function numbers(text, name) {
  const part = text.match(new RegExp(`<DataArray [^>]*Name="${name}"[^>]*>([^<]*)</DataArray>`));
  return part[1].trim().split(/\s+/).map(Number);
}

export function cornersByBody(file) {
  const text = readFileSync(file, 'utf8');
  const points = text.match(/<Points>\s*<DataArray[^>]*>([^<]*)</)[1].trim().split(/\s+/).map(Number);
  const body = numbers(text.slice(text.indexOf('<CellData>')), 'body');
  const places = numbers(text, 'connectivity'), ends = numbers(text, 'offsets'), corners = new Map();
  body.forEach((b, cell) => {
    for (const place of places.slice(cell ? ends[cell - 1] : 0, ends[cell])) {
      if (!corners.has(b)) corners.set(b, new Set());
      corners.get(b).add(place);
    }
  });
  const at = (place) => points.slice(3 * place, 3 * place + 3);
  return new Map([...corners].map(([b, list]) => [b, [...list].sort((x, y) => x - y).map(at)]));
}
