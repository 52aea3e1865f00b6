// Runs before the theme's own script.

// The theme forgets what was typed before its index has come: when it has, it asks the same again and takes it for answered.
// Said twice, it is another question with the same answer.
var __search = {
  transform(typed) {
    const words = typed
      .split(/"([^"]+)"/g)
      .map((part, i) => (i % 2 === 1 ? part.replace(/^\b|^(?![^\x00-\x7F]|$)|\s+/g, ' +') : part)) // "a phrase": all of its words
      .join('')
      .replace(/"|(?:^|\s+)[*+\-:^~]+(?=\s+|$)/g, '')
      .trim();
    const answer = document.querySelector('.md-search-result__meta');
    answer.dataset.first ??= answer.textContent;
    const isWaiting = words !== '' && answer.textContent === answer.dataset.first;
    __search.isTwice = isWaiting && !__search.isTwice;
    return __search.isTwice ? `${words} ${words}` : words;
  },
  isTwice: false,
};

// The theme puts wide tables into frames that scroll. The keyboard reaches them, too.
addEventListener('load', () => {
  for (const frame of document.querySelectorAll('.md-typeset__scrollwrap')) frame.tabIndex = 0;
});
