// The sources of the program, for tests that hold the page's tables against them.
import { readdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';

const root = resolve(import.meta.dirname, '../../src');
export const sources = (below = ''): string[] =>
  readdirSync(join(root, below), { recursive: true, encoding: 'utf8' })
    .filter((name) => /\.(cpp|hpp)$/.test(name) && !name.includes('tests/') && !name.includes('fuzz/'))
    .map((name) => readFileSync(join(root, below, name), 'utf8'));
export const source = (name: string): string => readFileSync(join(root, name), 'utf8');

// All texts of sources, those that stand side by side joined.
export const textsOf = (all: readonly string[]): string[] =>
  all
    .flatMap((text) => [...text.matchAll(/"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*/g)])
    .map((one) => one[0].replace(/"\s*"/g, '').slice(1, -1));
