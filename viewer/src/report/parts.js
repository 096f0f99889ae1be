// Parts of which both reports are made.
import { element, list } from './table.js';

export const section = (title, ...children) => {
  const shown = children.flat().filter(Boolean);
  return shown.length ? element('section', {}, element('h2', {}, title), ...shown) : null;
};
export const paragraph = (text, attributes = {}) => (text ? element('p', attributes, text) : null);
export const bullets = (lines) => (lines.length ? element('ul', {}, ...lines.map((line) => element('li', {}, line))) : null);

// title, the user's title block, and how it ended
export function header(title, block, { class: kind, text }) {
  return element('header', {}, element('h1', {}, title),
    list([['project', block.project], ['section', block.section], ['author', block.author], ['checked by', block.checked_by], ['date', block.date]]),
    paragraph(text, { class: `status ${kind}` }));
}
