import { existsSync, readFileSync } from 'node:fs';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';

const worthCompressing = /\.(html|js|css|svg|json|wasm)$/;

// Puts a .br and a .gz beside each file, so that the server never compresses. Other plugins still change the files while
// the bundle is generated, so this is done when all are written.
function precompressed(): Plugin {
  return {
    name: 'precompressed',
    apply: 'build',
    async writeBundle({ dir = '.' }) {
      const params = { [constants.BROTLI_PARAM_QUALITY]: constants.BROTLI_MAX_QUALITY };
      for (const name of await readdir(dir, { recursive: true })) {
        if (!worthCompressing.test(name)) continue;
        const bytes = await readFile(join(dir, name));
        await writeFile(join(dir, `${name}.br`), brotliCompressSync(bytes, { params }));
        await writeFile(join(dir, `${name}.gz`), gzipSync(bytes, { level: 9 }));
      }
    },
  };
}

// The lab's module, which CMake makes of the program's own sources. Without it the page has all but the lab.
const labModule = process.env.PASSO_LAB_WASM ?? '../build/release/src/lab/lab.wasm';
function lab(): Plugin {
  return {
    name: 'lab',
    generateBundle() {
      if (existsSync(labModule)) {
        this.emitFile({ type: 'asset', fileName: 'lab.wasm', source: readFileSync(labModule) });
      } else {
        this.warn(`${labModule} is not there: the page has no lab`);
      }
    },
    configureServer(server) {
      server.middlewares.use('/lab.wasm', (_, reply) => {
        reply.setHeader('Content-Type', 'application/wasm');
        reply.end(readFileSync(labModule));
      });
    },
  };
}

export default defineConfig({
  base: './',
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact' },
  plugins: [lab(), precompressed()],
  build: {
    target: 'es2022',
    outDir: process.env.PASSO_PAGE_OUT ?? '../build/page',
    emptyOutDir: true,
    assetsInlineLimit: 0, // the page's policy allows no data: URLs
    modulePreload: { polyfill: false },
    reportCompressedSize: false,
  },
  server: {
    // For work on the page: `npx vite`, beside `passo serve --http 127.0.0.1:7080`.
    proxy: { '/api': { target: 'http://127.0.0.1:7080', ws: true, changeOrigin: true, rewriteWsOrigin: true } },
  },
  test: { include: ['tests/**/*.test.ts'], environment: 'node' },
});
