// Makes elements from data. Text is always a text node: nothing that a user wrote is read as HTML.

const kSvg = 'http://www.w3.org/2000/svg';

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (name === 'style' && typeof value === 'object') Object.assign(element.style, value);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    element.append(child instanceof Node ? child : document.createTextNode(String(child)));
  }
  return element;
}

export function h(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes, ...children) {
  return fill(document.createElementNS(kSvg, tag), attributes, children);
}

export function replace(element, ...children) {
  element.replaceChildren(...children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false));
  return element;
}

// Makes a table of columns [{title, unit, align, of: row => cell}]. Wide tables scroll by themselves.
export function table(columns, rows, attributes) {
  const kind = (column) => (column.text ? 'text' : 'number');
  return h('div', { class: 'scroll' },
    h('table', attributes,
      h('thead', null, h('tr', null, columns.map((c) =>
        h('th', { class: kind(c), scope: 'col' }, c.title, c.unit ? h('span', { class: 'unit' }, ' ', c.unit) : null)))),
      h('tbody', null, rows.map((row) => h('tr', row.attributes || null, columns.map((c, i) =>
        h(i === 0 ? 'th' : 'td', { class: kind(c), scope: i === 0 ? 'row' : null }, c.of(row))))))));
}

export function section(id, title, lead, ...children) {
  return h('section', { id }, h('h2', null, title), lead ? h('p', { class: 'lead' }, lead) : null, children);
}

export function details(summary, ...children) {
  return h('details', null, h('summary', null, summary), children);
}
