// Builds dist/ from src/: one script, one style sheet, and the licences of what is in them. `--check` compares.

import { build } from "esbuild";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const dist = join(here, "dist");

async function built() {
  const options = {
    absWorkingDir: here,
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    charset: "utf8",
    legalComments: "none",
    target: "es2023",
  };
  const script = await build({ ...options, entryPoints: ["src/main.js"], format: "esm", outfile: "dist/explorer.js" });
  const style = await build({ ...options, entryPoints: ["src/style.css"], outfile: "dist/explorer.css" });
  return {
    "explorer.js": script.outputFiles[0].text,
    "explorer.css": style.outputFiles[0].text,
    "THIRD_PARTY_LICENSES.txt": licences(script.metafile),
  };
}

/** Return the licence of every package whose code is in the script. */
function licences(metafile) {
  const inputs = Object.keys(Object.values(metafile.outputs)[0].inputs);
  const names = [
    ...new Set(inputs.map((path) => path.match(/^node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1]).filter(Boolean)),
  ].sort();
  const texts = names.map((name) => {
    const folder = join(here, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    return `${name} ${version} (${license})\n\n${readFileSync(join(folder, "LICENSE"), "utf8").trim()}\n`;
  });
  return ["The script of the explorer contains the following packages.\n", ...texts].join(`\n${"-".repeat(80)}\n\n`);
}

const files = await built();
if (process.argv.includes("--check")) {
  const other = Object.entries(files)
    .filter(([name, text]) => readFileSync(join(dist, name), "utf8") !== text)
    .map(([name]) => name);
  if (other.length) {
    console.error(`explorer: dist/ is not what src/ builds to: ${other.join(", ")}; run make explorer-bundle`);
    process.exit(1);
  }
  console.log("explorer: dist/ is what src/ builds to");
} else {
  mkdirSync(dist, { recursive: true });
  for (const [name, text] of Object.entries(files)) {
    writeFileSync(join(dist, name), text);
    console.log(`explorer: dist/${name}: ${text.length} characters`);
  }
}
