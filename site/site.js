// The theme puts wide tables into frames that scroll. The keyboard reaches them, too.
addEventListener('load', () => {
  for (const frame of document.querySelectorAll('.md-typeset__scrollwrap')) frame.tabIndex = 0;
});
