// Elements and tables. Text is only inserted as text.
import { asTyped } from '../colours.js';

export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

const quoted = (cell) => (/[",\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell);

export function csvOf(rows) { return rows.map((row) => row.map((cell) => quoted(asTyped(String(cell)))).join(',')).join('\n') + '\n'; }

// Copies through the clipboard, or where a browser refuses it to a page from disk, through a selected text.
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const box = element('textarea');
    box.value = text;
    document.body.append(box);
    box.select();
    document.execCommand('copy');
    box.remove();
  }
}

export function copyButton(words, text) {
  const button = element('button', { type: 'button', class: 'small' }, words);
  button.onclick = async () => {
    await copy(text());
    button.textContent = 'copied';
    setTimeout(() => { button.textContent = words; }, 1200);
  };
  return button;
}

// `numbers`: places of columns that are aligned to the right
export function table(head, rows, { numbers = [], caption = '' } = {}) {
  const kind = (k) => (numbers.includes(k) ? { class: 'number' } : {});
  const made = element('table', {},
    ...(caption ? [element('caption', {}, caption)] : []),
    element('thead', {}, element('tr', {}, ...head.map((cell, k) => element('th', { scope: 'col', ...kind(k) }, cell)))),
    element('tbody', {}, ...rows.map((row) => element('tr', {}, ...row.map((cell, k) => element('td', kind(k), String(cell)))))));
  return element('div', { class: 'table' }, made, copyButton('copy as CSV', () => csvOf([head, ...rows])));
}

// [["name", "value"], …]; rows without a value are left out
export function list(rows) {
  return element('dl', {}, ...rows.filter(([, value]) => value !== '' && value !== undefined && value !== null)
    .flatMap(([name, value]) => [element('dt', {}, name), element('dd', {}, value)]));
}

// A comma-separated file of the program: names of its columns, and its rows as texts. Cells may be quoted.
export function readCsv(text) {
  const head = [], all = [head];
  for (const [, quotedCell, plain, end] of text.trimEnd().matchAll(/(?:"((?:[^"]|"")*)"|([^,\n]*))(,|\n|$)/g)) {
    all.at(-1).push(quotedCell?.replaceAll('""', '"') ?? plain);
    if (end === '\n') all.push([]);
    if (end === '') break;
  }
  return { head, rows: all.slice(1) };
}

export function save(name, blob) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
