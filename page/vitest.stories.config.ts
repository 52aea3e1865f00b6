import { defineConfig } from 'vitest/config';

// The stories share a daemon, and follow one another. Nothing is measured here, so they wait as long as a busy computer needs.
export default defineConfig({
  test: { include: ['stories/**/*.test.ts'], environment: 'node', testTimeout: 600_000, hookTimeout: 120_000, fileParallelism: false, expect: { poll: { timeout: 240_000 } } },
});
