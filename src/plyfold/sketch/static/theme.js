// Light or dark: as the system has it, until someone chooses.

const dark = matchMedia("(prefers-color-scheme: dark)");
const root = document.documentElement;

function apply(page) {
  const chosen = localStorage.getItem("plyfold.theme");
  root.dataset.theme = chosen ?? (dark.matches ? "dark" : "light");
  page.store.set({ theme: root.dataset.theme });
  page.surface?.set({ dark: root.dataset.theme === "dark" });
}

export function followTheme(page) {
  page.changeTheme = () => {
    localStorage.setItem("plyfold.theme", root.dataset.theme === "dark" ? "light" : "dark");
    apply(page);
  };
  dark.addEventListener("change", () => apply(page));
  apply(page);
}
