// Serves this folder on localhost, and a tree as tree.glb: node serve.mjs [TREE.glb] [PORT].
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize, resolve, sep } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const FOLDER = fileURLToPath(new URL(".", import.meta.url));
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".glb": "model/gltf-binary" };

// A server that listens; port 0 takes a free one.
export function serve(tree, port) {
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
    const file = path === "/tree.glb" ? resolve(tree) : normalize(join(FOLDER, path === "/" ? "index.html" : path));
    try {
      if (path !== "/tree.glb" && !file.startsWith(FOLDER.replace(/[/\\]?$/, sep))) throw new Error("outside");
      const bytes = await readFile(file);
      response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((done) => server.listen(port, "127.0.0.1", () => done(server)));
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const [tree = "tree.glb", port = "8080"] = process.argv.slice(2);
  const server = await serve(tree, Number(port));
  console.log(`http://localhost:${server.address().port}/ shows ${tree}`);
}
