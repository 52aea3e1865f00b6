// Modules of the program's own sources, compiled to WebAssembly (cmake/PassoWasm.cmake).
export async function loadModule(name: string): Promise<WebAssembly.Exports> {
  const reply = await fetch(new URL(name, document.baseURI));
  if (!reply.ok) throw new Error(reply.statusText);
  return startModule(await reply.arrayBuffer());
}

// The C library may ask for files and clocks, which a page does not have: it is refused.
export async function startModule(bytes: BufferSource): Promise<WebAssembly.Exports> {
  const module = await WebAssembly.compile(bytes);
  const refused = 8;
  const imports: WebAssembly.Imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] = { ...imports[from], [name]: () => refused };
  }
  const { exports } = await WebAssembly.instantiate(module, imports);
  (exports._initialize as (() => void) | undefined)?.();
  return exports;
}
