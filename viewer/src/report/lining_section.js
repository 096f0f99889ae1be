// The strength of a lining's section, and places along its outline.

// The moments at which an elastic section reaches its strength at an edge (core/support/lining.cpp, use_of), as a closed
// curve of [moment, thrust] per metre: 6|M|/t² + N/t = compressive, 6|M|/t² - N/t = tensile strength.
export function envelope({ thickness_m: t, compressive_strength_Pa: compressive, tensile_strength_Pa: tensile }) {
  if (!(t > 0 && compressive > 0 && tensile >= 0)) return [];
  const most = ((compressive + tensile) * t * t) / 12, at = ((compressive - tensile) * t) / 2;
  return [[0, compressive * t], [most, at], [0, -tensile * t], [-most, at], [0, compressive * t]];
}

// degrees about the middle of the nodes, which follow each other counter-clockwise: from 0 at the right, 90 at the crown
export function angles(nodes) {
  const middle = (of) => nodes.reduce((sum, node) => sum + of(node), 0) / nodes.length, x = middle((node) => node.x), y = middle((node) => node.y);
  const turns = nodes.map((node) => (Math.atan2(node.y - y, node.x - x) * 180) / Math.PI), out = [];
  for (const turn of turns) {
    const last = out.at(-1);
    out.push(last === undefined ? (turn < -90.5 ? turn + 360 : turn) : last + ((((turn - last) % 360) + 360) % 360));
  }
  return out;
}
