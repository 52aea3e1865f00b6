// A sentence of the daemon in four languages. What stands in braces is taken over; {state} and {saying} are translated
// themselves, {z}, {place} and {feed} are shown in the units of the page. A bar stands where the daemon puts texts together. A test finds each English sentence in the program's sources.
export interface Saying {
  en: string;
  fr: string;
  it: string;
  zh: string;
}
export const saying = (en: string, fr: string, it: string, zh: string): Saying => ({ en, fr, it, zh });
