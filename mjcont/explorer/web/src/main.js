// Where the page begins: the document stands in it, or a session has it. In a notebook the widget begins instead.

import { mount } from "./app.js";
import { connect } from "./transport.js";

export { mount } from "./app.js";

async function begin(root) {
  const given = JSON.parse(document.getElementById("document").textContent);
  if (given) return mount(root, given);
  const transport = await connect();
  const found = await transport.request("document", {});
  return mount(root, found, transport);
}

const root = document.getElementById("explorer");
if (root && document.getElementById("document"))
  begin(root).catch((error) => {
    root.textContent = String(error.message ?? error);
  });
