// Browsers run no modules from file:// addresses. A plain script can say so.
if (location.protocol === 'file:') document.getElementById('from-file')?.removeAttribute('hidden');
