// Reads a list of documents in JSON; writes what becomes of each in the page's links, and the text of the page's files.

import { asText, decode, encode } from "../../src/plyfold/sketch/static/link.js";

const read = async () => {
  let text = "";
  for await (const piece of process.stdin) text += piece;
  return JSON.parse(text);
};

const through = async (document) => ({ link: await decode(await encode(document)), file: asText(document) });
process.stdout.write(JSON.stringify(await Promise.all((await read()).map(through))));
