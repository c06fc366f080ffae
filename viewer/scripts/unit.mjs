// Bundles the unit tests one by one and runs them with Node's own test runner.
import { readdir } from "node:fs/promises";
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const root = fileURLToPath(new URL("..", import.meta.url));
const tests = (await readdir(join(root, "test/unit"))).filter((name) => name.endsWith(".test.ts"));
const outdir = join(root, "node_modules/.cache/wedgelab-unit");
await build({
  absWorkingDir: root,
  entryPoints: tests.map((name) => join("test/unit", name)),
  bundle: true,
  platform: "node",
  format: "esm",
  outdir,
  outExtension: { ".js": ".mjs" },
  logLevel: "warning",
});
const files = tests.map((name) => join(outdir, name.replace(/\.ts$/, ".mjs")));
const { status } = spawnSync(process.execPath, ["--test", ...files], { stdio: "inherit" });
process.exit(status ?? 1);
