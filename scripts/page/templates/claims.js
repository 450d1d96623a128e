"use strict";
// The filter of the claims by verdict and by words, and links that lead into folded parts.

function claimFilter(filter) {
  const claims = [...document.querySelectorAll(".claim")];
  const parts = [...document.querySelectorAll("main .part, main .appendix")];
  const buttons = [...filter.querySelectorAll("button")];
  const search = filter.querySelector("input");
  const read = filter.querySelector(".read");
  const folded = new Map(parts.filter((part) => part.tagName === "DETAILS").map((part) => [part, part.open]));

  function apply() {
    const verdicts = buttons.filter((button) => button.ariaPressed === "true").map((button) => button.dataset.verdict);
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const filtering = verdicts.length + words.length > 0;
    document.documentElement.classList.toggle("filtering", filtering);
    const found = claims.filter((claim) => {
      const text = `${claim.dataset.words} ${claim.textContent}`.toLowerCase();
      return words.every((word) => text.includes(word));
    });
    for (const claim of claims) {
      claim.hidden = !found.includes(claim) || (verdicts.length > 0 && !verdicts.includes(claim.dataset.verdict));
    }
    for (const button of buttons) {
      const count = found.filter((claim) => claim.dataset.verdict === button.dataset.verdict).length;
      button.querySelector("span").textContent = `${count} claim${count === 1 ? "" : "s"}`;
    }
    for (const part of parts) part.classList.toggle("empty", filtering && !part.querySelector(".claim:not([hidden])"));
    for (const [part, open] of folded) part.open = filtering || open;
    const shown = claims.filter((claim) => !claim.hidden).length;
    read.textContent = filtering ? `${shown} of ${claims.length} are shown.` : "";
  }

  for (const button of buttons) {
    button.disabled = false;
    button.addEventListener("click", () => {
      button.ariaPressed = String(button.ariaPressed !== "true");
      apply();
      if (window.scrollY > filter.offsetTop) filter.scrollIntoView();
    });
  }
  search.disabled = false;
  search.addEventListener("input", apply);
  return function clear() {
    for (const button of buttons) button.ariaPressed = "false";
    search.value = "";
    apply();
  };
}

// A link leads to a claim or a figure even if the filter hides it or its appendix is folded.
function reveal(clear) {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  if (target.closest("[hidden], .empty")) clear();
  for (let fold = target.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
  target.scrollIntoView();
}

document.documentElement.classList.add("scripted");
const filter = document.getElementById("claims");
if (filter) {
  const clear = claimFilter(filter);
  window.addEventListener("hashchange", () => reveal(clear));
  if (location.hash) reveal(clear);
}
