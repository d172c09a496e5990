// Bundle each widget's modules and style sheet into one file of ../static. These files are committed, so that installing
// the package needs no Node.
//
//   node build.js           write the bundles
//   node build.js --check   fail if a committed bundle differs from what would be written

import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { build } from "esbuild";

const SOURCES = import.meta.dirname;
const BUNDLES = join(SOURCES, "..", "static");
const BANNER = "/* Bundled from seiswidgets/widgets/js by `make js`: edit the sources, not this file. */";

async function bundle() {
  const entries = readdirSync(SOURCES).filter(
    (name) => /\.(js|css)$/.test(name) && name !== basename(import.meta.filename),
  );
  const { outputFiles } = await build({
    absWorkingDir: SOURCES,
    entryPoints: entries,
    outdir: BUNDLES,
    bundle: true,
    format: "esm",
    target: "es2022",
    charset: "utf8",
    banner: { js: BANNER, css: BANNER },
    write: false, // not minified: a reviewer can read what a change does to a bundle
  });
  return new Map(outputFiles.map(({ path, text }) => [basename(path), text]));
}

/** @returns {Map<string, string>} */
function committed() {
  mkdirSync(BUNDLES, { recursive: true });
  return new Map(readdirSync(BUNDLES).map((name) => [name, readFileSync(join(BUNDLES, name), "utf8")]));
}

const [wanted, present] = [await bundle(), committed()];
const outdated = [...new Set([...wanted.keys(), ...present.keys()])].filter(
  (name) => wanted.get(name) !== present.get(name),
);
if (process.argv.includes("--check")) {
  if (outdated.length) {
    process.stderr.write(
      `bundles differ from their sources: ${outdated.join(", ")}; run make js and commit the result\n`,
    );
    process.exitCode = 1;
  }
} else {
  for (const name of outdated) {
    const text = wanted.get(name);
    if (text === undefined) rmSync(join(BUNDLES, name));
    else writeFileSync(join(BUNDLES, name), text);
  }
}
