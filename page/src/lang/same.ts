// What a translation has to have: a word for each key of English. The compiler finds one that is missing, or too much.
import type { en } from './en/index';

export type Same<English> = { [K in keyof English]: string };
export type Words = Same<typeof en>;
