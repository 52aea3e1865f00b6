// What the daemon says, in the language of the page.
export const told = (words: string): string | null => (words === '' ? '' : null);
