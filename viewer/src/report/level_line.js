// Segments between the places (0 … nx - 1, 0 … ny - 1) at which values, x changing fastest, cross a level; each square of
// four is halved, so that the line has no ambiguous case. Squares without a value have none.
export function levelLine(values, nx, level) {
  const at = (x, y) => ({ x, y, v: values[y * nx + x] - level }), segments = [];
  for (let y = 0; y + 1 < values.length / nx; ++y) for (let x = 0; x + 1 < nx; ++x)
    for (const corners of [[at(x, y), at(x + 1, y), at(x + 1, y + 1)], [at(x, y), at(x, y + 1), at(x + 1, y + 1)]]) {
      if (!corners.every((c) => Number.isFinite(c.v))) continue;
      const ends = [[0, 1], [1, 2], [2, 0]].map(([i, j]) => [corners[i], corners[j]]).filter(([a, b]) => (a.v < 0) !== (b.v < 0))
        .map(([a, b]) => { const t = a.v / (a.v - b.v); return [a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)]; });
      if (ends.length === 2) segments.push(ends);
    }
  return segments;
}
