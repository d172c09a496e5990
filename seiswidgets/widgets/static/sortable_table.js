/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */

// sortable_table.js
function draw(model, head, body) {
  const [column, descending] = model.get("sorted");
  const headings = model.get("headings").map((heading, index) => {
    const cell = document.createElement("th");
    cell.scope = "col";
    if (index === column) cell.setAttribute("aria-sort", descending ? "descending" : "ascending");
    const mark = index === column ? descending ? " ▼" : " ▲" : "";
    cell.append(button(heading + mark, `sort by ${heading}`, () => model.send({ kind: "sort", column: index })));
    return cell;
  });
  const row = document.createElement("tr");
  row.append(...headings);
  const focused = focusedIndex(head, body);
  head.replaceChildren(row);
  body.replaceChildren(...model.get("rows").map((one) => bodyRow(one, model)));
  if (focused >= 0) [...head.querySelectorAll("button"), ...body.querySelectorAll("button")][focused]?.focus();
}
function bodyRow(one, model) {
  const row = document.createElement("tr");
  row.title = one.title;
  row.classList.toggle("chosen", one.chosen);
  row.classList.toggle("dim", one.dim);
  const name = document.createElement("th");
  name.scope = "row";
  const choose = button(one.name, `show ${one.name}`, () => model.send({ kind: "choose", name: one.name }));
  choose.setAttribute("aria-pressed", String(one.chosen));
  name.append(choose);
  const cells = one.cells.map((text) => {
    const cell = document.createElement("td");
    cell.textContent = text;
    return cell;
  });
  row.append(name, ...cells);
  return row;
}
function button(text, label, act) {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  made.setAttribute("aria-label", label);
  made.addEventListener("click", act);
  return made;
}
function focusedIndex(head, body) {
  const buttons = [...head.querySelectorAll("button"), ...body.querySelectorAll("button")];
  return buttons.indexOf(document.activeElement);
}
function render({ model, el }) {
  const table = document.createElement("table");
  table.className = "seiswidgets-table";
  const head = table.createTHead();
  const body = table.createTBody();
  el.append(table);
  const show = () => draw(model, head, body);
  const names = (
    /** @type {const} */
    ["headings", "rows", "sorted"]
  );
  for (const name of names) model.on(`change:${name}`, show);
  show();
  return () => {
    for (const name of names) model.off(`change:${name}`, show);
  };
}
var sortable_table_default = { render };
export {
  sortable_table_default as default
};
