import { readdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';
import { modules } from './vite.modules';

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

export default defineConfig({
  base: './',
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact' },
  plugins: [modules('lab.wasm', 'stock.wasm'), precompressed()],
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
