// SVG by hand. Text is only inserted as text.
export function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

export const FONT = 'DejaVu Sans, Helvetica, Arial, sans-serif';

// dark on a light rim, so that it can be read on anything
export function label(x, y, text, attributes = {}) {
  return svg('text', { x, y, 'font-family': FONT, 'font-size': 12, fill: '#202020', stroke: '#ffffff', 'stroke-width': 3,
    'paint-order': 'stroke', 'stroke-linejoin': 'round', ...attributes }, text);
}

export const shortened = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}…` : text);
