// What prints a design: a file that the page has, or the command that writes it.

// The name of the results file as a word of a shell.
function wordOf(file) {
  return /^[\w./-]+$/.test(file) ? file : `'${file.replaceAll("'", "'\\''")}'`;
}

// Sheets are cut to a panel (m); without one, to a period. null: there is no part to print.
function exportCommand({ id, print, outer }, file, panel) {
  if (print === null) return null;
  const lengths = panel ? panel.map((side) => Number(inUnits(side, "mm").toPrecision(6))) : outer.map((side) => Math.ceil(inUnits(side, "mm")));
  const sides = print === "--panel" ? lengths.map((mm) => ` "${mm} mm"`).join("") : "";
  return `crumple export ${wordOf(file)} ${id} --to best.3mf${print && ` ${print}`}${sides}`;
}

function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}
