// What the daemon says of itself: docs/api/openapi.json, which tests of the daemon hold to the program.
import { readFileSync } from 'node:fs';
import { operations, type CamOperation } from '../src/machine/cam';

interface Description {
  components: { schemas: Record<string, unknown> };
}
export const description = (): Description => JSON.parse(readFileSync(new URL('../../docs/api/openapi.json', import.meta.url), 'utf8')) as Description;

const isOperation = (schema: unknown): schema is CamOperation => typeof schema === 'object' && schema !== null && 'x-accepts' in schema;
// As if GET /cam/operations had been answered.
export function knowOperations(): void {
  operations.value = Object.values(description().components.schemas).filter(isOperation);
}
