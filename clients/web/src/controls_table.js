// ControlsTable: the server's schema of controls, artefacts and faults, from which the panels and the messages are made.
// Each entry is an object of /controls.json (server/net/http/controls_page.hpp).

// Asks until the server answers; failed(error) is told of each time that it does not.
export async function loadControls(url, failed, waitMs = 1000) {
  for (;;) {
    try {
      const response = await fetch(url, { cache: 'no-store' });
      if (!response.ok) throw new Error(`${url}: HTTP status ${response.status}`);
      const table = await response.json();
      if (!Array.isArray(table.controls) || !Array.isArray(table.artefacts)) throw new Error(`${url}: no table of controls`);
      return table;
    } catch (error) {
      failed(error);
      await new Promise((resolve) => setTimeout(resolve, waitMs));
    }
  }
}

// How the panel shows a control: 'slider', 'number', 'switch' or 'choice'; null: not by itself.
export function widgetOf(control) {
  if (!control.panel) return null;
  if (control.type === 'switch' || control.type === 'choice') return control.type;
  if (control.type !== 'number' || control.oneOf) return null;
  return control.min === 0 && control.max === 100 && !control.unit ? 'slider' : 'number';
}
