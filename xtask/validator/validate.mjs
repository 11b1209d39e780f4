// Runs the Khronos validator over the files of the command line: one JSON line each,
// {file, complaints: {"SEVERITY CODE": count}}.
import { readFileSync } from "node:fs";
import { basename, dirname, resolve } from "node:path";
import validator from "gltf-validator";

const SEVERITIES = ["error", "warning"];

for (const file of process.argv.slice(2)) {
  const complaints = {};
  const count = (what) => (complaints[what] = (complaints[what] ?? 0) + 1);
  try {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
      uri: basename(file),
      maxIssues: 0,
      externalResourceFunction: async (uri) =>
        new Uint8Array(readFileSync(resolve(dirname(file), decodeURIComponent(uri)))),
    });
    for (const message of report.issues.messages) {
      if (message.severity < SEVERITIES.length) count(`${SEVERITIES[message.severity]} ${message.code}`);
    }
    if (report.issues.truncated) count("error TRUNCATED");
  } catch (error) {
    count(`error UNREADABLE ${error}`);
  }
  console.log(JSON.stringify({ file, complaints }));
}
