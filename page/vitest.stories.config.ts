import { defineConfig } from 'vitest/config';

// The stories share a daemon, and follow one another.
export default defineConfig({
  test: { include: ['stories/**/*.test.ts'], environment: 'node', testTimeout: 90_000, hookTimeout: 60_000, fileParallelism: false },
});
