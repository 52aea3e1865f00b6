// The pages of the site that need no server: PASSO_SITE_PAGE=lab builds page/lab.html into PASSO_SITE_OUT/lab/index.html.
// Each page is a build and a folder of its own. scripts/site.sh builds all those whose html file exists.
import { readFileSync } from 'node:fs';
import { rename } from 'node:fs/promises';
import { join } from 'node:path';
import { defineConfig, type Plugin } from 'vite';
import { modules, type WasmName } from './vite.modules';

// The modules of each page: a page fetches its own beside its html file (core/wasm.ts).
const modulesOf: Record<string, readonly WasmName[]> = { lab: ['lab.wasm'], check: ['check.wasm'] };

const page = process.env.PASSO_SITE_PAGE ?? 'lab';
const outDir = join(process.env.PASSO_SITE_OUT ?? '../build/site-pages', page);

// The html file is the index of its folder. A plain script says why a page from a file:// address stays empty.
function asFolder(): Plugin {
  return {
    name: 'as-folder',
    apply: 'build',
    generateBundle() {
      this.emitFile({ type: 'asset', fileName: 'from_file.js', source: readFileSync('src/site/from_file.js') });
    },
    writeBundle: () => rename(join(outDir, `${page}.html`), join(outDir, 'index.html')),
  };
}

export default defineConfig({
  base: './', // any sub-path
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact' },
  plugins: [modules(...(modulesOf[page] ?? [])), asFolder()],
  build: {
    target: 'es2022',
    outDir,
    emptyOutDir: true,
    assetsInlineLimit: 0, // the pages' policy allows no data: URLs
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
    rollupOptions: { input: `${page}.html` },
  },
});
