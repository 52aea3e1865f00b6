// Browsers run no modules from file:// addresses, so a plain script shows the explanation.
if (location.protocol === 'file:') document.getElementById('from-file')?.removeAttribute('hidden');
