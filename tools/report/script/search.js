// The index of all reports: a box that leaves the cases in which all of its words occur.
const box = document.getElementById('search'), words = document.getElementById('search-words');
if (box) {
  const cards = [...document.querySelectorAll('[data-words]')];
  const parts = [...document.querySelectorAll('section.chapter')];
  box.closest('p').hidden = false;
  const look = () => {
    const wanted = box.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const card of cards) {
      card.hidden = !wanted.every(word => card.dataset.words.includes(word));
      shown += card.hidden ? 0 : 1;
    }
    for (const part of parts) part.hidden = !part.querySelector('[data-words]:not([hidden])');
    words.textContent = wanted.length > 0 ? `${shown} of ${cards.length}` : '';
  };
  box.addEventListener('input', look);
  look();
}
