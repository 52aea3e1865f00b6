// The modules that CMake makes of the program's own sources, as files of a page.
import { existsSync, readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const built = (path: string, variable: string): string => process.env[variable] ?? `../build/release/src/${path}`;
export const wasm = {
  'lab.wasm': built('study/lab/lab.wasm', 'PASSO_LAB_WASM'),
  'check.wasm': built('interfaces/browser/check.wasm', 'PASSO_CHECK_WASM'),
  'stock.wasm': built('cam/stock/stock.wasm', 'PASSO_STOCK_WASM'),
} as const;
export type WasmName = keyof typeof wasm;

// Without a module the page lacks what needs it, and the build says so.
export function modules(...names: WasmName[]): Plugin {
  return {
    name: 'modules',
    generateBundle() {
      for (const fileName of names) {
        if (existsSync(wasm[fileName])) this.emitFile({ type: 'asset', fileName, source: readFileSync(wasm[fileName]) });
        else this.warn(`${wasm[fileName]} is missing: the page has no ${fileName}`);
      }
    },
    configureServer(server) {
      for (const name of names) {
        server.middlewares.use(`/${name}`, (_, reply) => {
          reply.setHeader('Content-Type', 'application/wasm');
          reply.end(readFileSync(wasm[name]));
        });
      }
    },
  };
}
