import type { en } from './en';

// What each language has to have.
export type CamWords = { [K in keyof typeof en]: string };
