// Opens the example page in headless Chromium, once per address, and writes what it shows as PNG: node shoot.mjs
// CHROMIUM TREE.glb FOLDER NAME=QUERY ... Prints the page's title for each. Talks to Chromium through a pipe, and
// serves on localhost.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { serve } from "../../docs/examples/minimal/serve.mjs";

const SIZE = { width: 480, height: 480 };
// A page that has drawn nothing by then never will.
const PATIENCE_MS = 120_000;
const [chromium, tree, folder, ...pages] = process.argv.slice(2);

const profile = mkdtempSync(join(tmpdir(), "foliar-chromium-"));
const flags = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
  `--user-data-dir=${profile}`, "--remote-debugging-pipe", "about:blank"];
const browser = spawn(chromium, flags, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
const waiting = new Map();
const faults = [];
let last = 0;
browser.on("error", (error) => faults.push(error.message));
let rest = "";
browser.stdio[4].on("data", (bytes) => {
  const messages = (rest + bytes).split("\0");
  rest = messages.pop();
  for (const { id, result, error, method, params } of messages.map((text) => JSON.parse(text))) {
    if (id) error ? waiting.get(id).fail(new Error(error.message)) : waiting.get(id).done(result);
    if (method === "Runtime.exceptionThrown") faults.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Runtime.consoleAPICalled" && params.type === "error") faults.push(params.args.map((a) => a.value ?? a.description).join(" "));
  }
});

function ask(method, params = {}, sessionId) {
  const id = ++last;
  browser.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
  return new Promise((done, fail) => waiting.set(id, { done, fail }));
}

async function shoot(address, file) {
  const { targetId } = await ask("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await ask("Target.attachToTarget", { targetId, flatten: true });
  const page = (method, params) => ask(method, params, sessionId);
  await page("Runtime.enable");
  await page("Emulation.setDeviceMetricsOverride", { ...SIZE, deviceScaleFactor: 1, mobile: false });
  await page("Page.navigate", { url: address });
  const start = Date.now();
  for (;;) {
    const { result } = await page("Runtime.evaluate", { expression: "document.title" });
    if (result.value?.startsWith("drawn")) {
      console.log(`${file}: ${result.value}`);
      break;
    }
    if (faults.length || Date.now() - start > PATIENCE_MS) throw new Error(`${address}: ${faults.join("; ") || "drew nothing"}`);
    await new Promise((done) => setTimeout(done, 200));
  }
  // The canvas alone: the page's words are no tree.
  const canvas = "document.querySelector('canvas').toDataURL('image/png').split(',')[1]";
  const { result } = await page("Runtime.evaluate", { expression: canvas });
  if (faults.length) throw new Error(faults.join("; "));
  writeFileSync(file, Buffer.from(result.value, "base64"));
  await ask("Target.closeTarget", { targetId });
}

const server = await serve(tree, 0);
let status = 0;
try {
  for (const page of pages) {
    const [name, query] = [page.slice(0, page.indexOf("=")), page.slice(page.indexOf("=") + 1)];
    await shoot(`http://127.0.0.1:${server.address().port}/?${query}`, join(folder, `${name}.png`));
  }
} catch (error) {
  console.error(`error: ${error.message}`);
  status = 1;
}
// Its profile can go once it is gone.
const gone = new Promise((done) => browser.once("exit", done));
ask("Browser.close").catch(() => {});
const patience = setTimeout(() => browser.kill("SIGKILL"), 5000);
await gone;
clearTimeout(patience);
server.close();
try {
  rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
} catch (error) {
  console.error(`${profile}: ${error.message}`);
}
process.exit(status);
