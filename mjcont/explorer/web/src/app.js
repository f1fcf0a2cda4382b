// The page put together: a document, the panels that draw it, and a session's transport where there is one.

import { poseOf, poseOfOrbit } from "./data.js";
import { Diagram } from "./diagram.js";
import { h, icon } from "./dom.js";
import { give } from "./download.js";
import { Grid } from "./grid.js";
import { listen } from "./keyboard.js";
import { frame, withPicture } from "./layout.js";
import { Live } from "./live.js";
import { Locus } from "./locus.js";
import { Mechanism, sceneOf } from "./mechanism.js";
import { Motion } from "./motion.js";
import { Player } from "./player.js";
import { Readout } from "./readout.js";
import { Spectrum } from "./spectrum.js";
import { Store } from "./store.js";
import { Tornado } from "./tornado.js";

const VERSION = 1;
// poses that a view is made to hold, of each curve; milliseconds after which a page is painted
const FRAMED = 40,
  PAINTED = 30;

/** Draw a document into an element; `transport` speaks with a session, null for a page of its own. */
export function mount(root, document, transport = null) {
  if (document.format !== "mjcont explorer" || document.version > VERSION)
    throw new Error(`this page draws documents of version ${VERSION}, not ${document.version}`);
  const store = new Store(document),
    made = frame(root, document.title),
    { panels } = made;
  store.live = Boolean(transport);
  panels.mechanism.show(Boolean(document.scene));
  const readout = new Readout(made.side, store),
    player = new Player(made.player, store);
  const plots = {
    diagram: new Diagram(panels.diagram, store),
    locus: new Locus(panels.locus, store),
    spectrum: new Spectrum(panels.spectrum, store),
    motion: new Motion(panels.motion, store),
    grid: new Grid(panels.grid, store),
  };
  new Tornado(panels.tornado, store);
  made.side.append(...readout.after, versions(document));
  for (const [name, plot] of Object.entries(plots)) withPicture(panels[name], () => plot.plot.svg);
  made.arrange();
  store.on("curves", made.arrange);
  listen(root, store, player);
  buttons(made.actions, store);
  const live = transport ? new Live(made, store, transport) : null;
  store.on("play", () => player.play());
  const explorer = { store, mechanism: null, panels, plots, player, live };
  root.explorer = explorer;
  // WebGL takes its time to begin: the diagram is on the screen by then
  if (document.scene)
    setTimeout(() => {
      const label = `The mechanism ${document.title}`;
      explorer.mechanism = new Mechanism(panels.mechanism.body, sceneOf(document.scene), label);
      follow(explorer.mechanism, store, panels.mechanism);
    }, PAINTED);
  return explorer;
}

/** Let the mechanism take the pose of what is selected. */
function follow(mechanism, store, panel) {
  const pose = () => {
    const { curve, row, sample } = store;
    if (!curve?.rows) return mechanism.scene.pose;
    return curve?.orbit?.poses ? poseOfOrbit(curve, row, sample) : poseOf(curve, row);
  };
  const frameAll = () => {
    const poses = store.curves.flatMap(posesOf);
    mechanism.frame(poses.length ? poses : [mechanism.scene.pose]);
  };
  const here = () => mechanism.pose(pose());
  store.on("row", here);
  store.on("curve", here);
  store.on("curves", () => {
    if (mechanism.untouched) frameAll();
    here();
  });
  frameAll();
  here();
  panel.tools.append(
    h(
      "button",
      { class: "icon", title: "Show all", "aria-label": "Show all of the mechanism", onclick: frameAll },
      icon("all"),
    ),
  );
  withPicture(panel, () => mechanism.picture());
}

/** Return some poses of a curve, evenly: of its rows, or of the motions of its orbits. */
function posesOf(curve) {
  if (!curve.poses) return [];
  const even = (count, most) =>
    Array.from({ length: Math.min(most, count) }, (_, k, n = Math.min(most, count)) =>
      Math.round((k * (count - 1)) / Math.max(n - 1, 1)),
    );
  if (!curve.orbit?.poses) return even(curve.rows, FRAMED).map((row) => poseOf(curve, row));
  const samples = even(curve.orbit.poses.shape[1], 12);
  return [...curve.orbit.rows].flatMap((row) => samples.map((sample) => poseOfOrbit(curve, row, sample)));
}

function buttons(host, store) {
  const { study, files, title } = store.document;
  if (study && !store.live)
    host.append(
      h(
        "button",
        {
          class: "take study",
          title: ["study.toml", ...Object.keys(files ?? {})].join(" and "),
          onclick: () => {
            give("study.toml", study, "text/plain");
            for (const [name, text] of Object.entries(files ?? {})) give(name, text, "text/xml");
          },
        },
        "study.toml",
      ),
    );
  host.append(
    h(
      "button",
      {
        class: "take theme",
        "aria-label": "Light or dark",
        title: "Light or dark",
        onclick: () => {
          const root = host.closest(".mjx"),
            dark = root.dataset.theme
              ? root.dataset.theme === "dark"
              : matchMedia("(prefers-color-scheme: dark)").matches;
          root.dataset.theme = dark ? "light" : "dark";
        },
      },
      icon("theme"),
    ),
  );
  host.dataset.title = title;
}

function versions(document) {
  const { mjcont, mujoco } = document.made;
  return h("p", { class: "made" }, `mjcont ${mjcont}, MuJoCo ${mujoco}`);
}
