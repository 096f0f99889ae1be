// The keys of the picture, and their table, hidden until it is asked for.
const KEYS = [['drag', 'rotates the blocks, in the plane moves them'], ['shift and drag, right button', 'moves'], ['wheel, + and −', 'zooms'],
  ['arrow keys', 'turn, with shift move'], ['Home', 'whole model'], ['space', 'plays the frames'], ['click', 'picks a block or a pole'],
  ['m', 'measures: two clicks, or Enter for the cross'], ['Escape', 'picks and measures nothing'], ['?', 'shows and hides this']];

export function keyTable() {
  const list = document.createElement('dl');
  list.className = 'keys';
  list.hidden = true;
  for (const [key, meaning] of KEYS) {
    const [term, text] = ['dt', 'dd'].map((name) => document.createElement(name));
    term.textContent = key;
    text.textContent = meaning;
    list.append(term, text);
  }
  return list;
}
