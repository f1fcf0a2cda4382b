// Where the page begins: the document stands in it, or a session has it. In a notebook the widget begins instead.

import { mount } from "./app.js";
import { connect, connectWidget } from "./transport.js";

export { mount } from "./app.js";

async function begin(root) {
  const given = JSON.parse(document.getElementById("document").textContent);
  if (given) return mount(root, given);
  const transport = await connect();
  const found = await transport.request("document", {});
  return mount(root, found, transport);
}

/** Draw a session into a cell of a notebook, and return what takes it away: the widget's side of anywidget. */
async function render({ model, el }) {
  const root = el.appendChild(document.createElement("div")),
    transport = connectWidget(model);
  try {
    mount(root, await transport.request("document", {}), transport);
    root.classList.add("embedded");
  } catch (error) {
    root.textContent = String(error.message ?? error);
  }
  return () => transport.close();
}

export default { render };

const root = document.getElementById("explorer");
if (root && document.getElementById("document"))
  begin(root).catch((error) => {
    root.textContent = String(error.message ?? error);
  });
