// Numbers as people read them.

/** "1,234,567". */
function grouped(n) {
  return Math.round(n).toLocaleString("en-US");
}

/** With so many significant digits, without zeros at the end. */
function rounded(x, digits) {
  return x === 0 ? "0" : String(Number(x.toPrecision(digits)));
}

/** "12 ms", "1.23 s". */
function secondsText(s) {
  return s < 0.9995 ? `${rounded(1000 * s, 3)} ms` : s < 120 ? `${rounded(s, 3)} s`
    : `${Math.floor(s / 60)} min ${Math.round(s % 60)} s`;
}

/** "7.1 MB". */
function sizeText(bytes) {
  return bytes < 1e6 ? `${rounded(bytes / 1e3, 3)} kB` : `${rounded(bytes / 1e6, 3)} MB`;
}

/** "1 sample" or "1,234 samples". */
function counted(n, one, many) {
  return `${grouped(n)} ${n === 1 ? one : many}`;
}

function element(name, text, className) {
  const made = document.createElement(name);
  if (text !== undefined) {
    made.textContent = text;
  }
  if (className) {
    made.className = className;
  }
  return made;
}

/** Fills a table with rows of a name and a value; rows without a value are left out. */
function fillTable(table, rows) {
  for (const [name, value] of rows) {
    if (value !== null && value !== undefined) {
      const row = table.insertRow();
      const head = element("th", name);
      head.scope = "row";
      row.append(head);
      row.insertCell().textContent = value;
    }
  }
}
