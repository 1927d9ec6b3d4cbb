// Links every card to its page of the manual.
import { h } from "./format.js";

const kFolder = "search/manual/";

/** The site's address relative to this page; null where there is none, or it cannot be opened. */
function address_of(place) {
  if (!place || location.protocol !== "file:") return null;
  return place.split("/").map(encodeURIComponent).join("/");
}

export function link_manual({ manual }) {
  const site = address_of(manual);
  for (const heading of document.querySelectorAll("[data-manual]")) {
    const file = heading.dataset.manual,
      page = file.slice(kFolder.length).replace(/\.md$/, ""),
      title = `Manual: ${page}`;
    heading.after(
      site
        ? h("a", { class: "manual", href: `${site}/${page}.html`, title, "aria-label": title }, "?")
        : h("abbr", { class: "manual", title: `${title} (${file}; misalign help --site)` }, "?"),
    );
  }
}
