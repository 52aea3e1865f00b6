// How much larger than usual the page's letters are: on large screens all grows with them, drawings too.
export const letterScale = (): number => parseFloat(getComputedStyle(document.documentElement).fontSize) / 16 || 1;
