// Validates GLB files with Khronos' validator: npm install gltf-validator, then node tools/validate_glb.mjs FILE...
// Prints the numbers of errors, warnings and infos of each file, and fails if there is an error or a warning.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const validator = createRequire(join(process.cwd(), "here.js"))("gltf-validator");

for (const path of process.argv.slice(2)) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(path)), { maxIssues: 20 });
  console.log(`${path}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos`);
  for (const { code, message, pointer, severity } of issues.messages) {
    if (severity < 2) console.log(`  ${code} ${pointer}: ${message}`);
  }
  if (issues.numErrors + issues.numWarnings) process.exitCode = 1;
}
