// Bundles the viewer and the explorer into viewer.js, explorer.js and their styles in the folder that is named, or in crates/report/viewer.
import { readFile, writeFile, mkdir } from "node:fs/promises";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const root = fileURLToPath(new URL("..", import.meta.url));
const out = process.argv[2] ?? join(root, "../crates/report/viewer");

const { outputFiles } = await build({
  absWorkingDir: root,
  entryPoints: { viewer: "src/main.ts", explorer: "src/explorer/main.ts" },
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2022"],
  legalComments: "inline",
  outdir: out,
  write: false,
  logLevel: "warning",
});

const licences = await Promise.all(
  ["three", "uplot"].map(async (name) => {
    const text = await readFile(join(root, "node_modules", name, "LICENSE"), "utf8");
    return `${name}:\n${text.trim()}`;
  }),
);
const head = `/*!\n${licences.join("\n\n").replaceAll("*/", "* /")}\n*/\n`;

await mkdir(out, { recursive: true });
for (const file of outputFiles) {
  const name = file.path.split(/[\\/]/).at(-1);
  // The files stand in elements of a page, which these would end.
  const text = file.text.replaceAll(/<\/(script|style)/gi, "<\\/$1").replaceAll("<!--", "<\\!--");
  const whole = name.endsWith(".js") ? head + text : text;
  const place = join(out, name);
  // Cargo builds again what has a new date.
  if (whole !== (await readFile(place, "utf8").catch(() => undefined))) {
    await writeFile(place, whole);
  }
  console.log(`${name}: ${(Buffer.byteLength(whole) / 1024).toFixed(0)} kB`);
}
