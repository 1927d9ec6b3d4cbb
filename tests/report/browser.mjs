// The system's Chromium with a page opened from a file, without a network.
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

// Packages may lie in a build directory: require also looks along NODE_PATH.
const { chromium } = createRequire(import.meta.url)("playwright-core");

/** No check fails for want of time: it waits for what is to happen, and only what is stuck is given up. */
export const kPatience_ms = 600000;

export function open_browser(more = [], options = {}) {
  return chromium.launch({
    executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-gpu-compositing", // WebGL alone in software: the page itself is drawn faster without
      ...more,
    ],
    timeout: kPatience_ms,
    ...options,
  });
}

/** The page, and a list that fills with everything a reader should not meet: errors, requests. */
export async function open_page(browser, report, options = {}) {
  // Smooth scrolling is off: what is measured must not move on before the mouse gets there.
  const context = await browser.newContext({ reducedMotion: "reduce", ...options });
  const problems = [];
  await context.route("**/*", (route) => {
    if (/^(file|data|blob):/.test(route.request().url())) return route.continue();
    problems.push(`asked for ${route.request().url()}`);
    return route.abort();
  });
  await context.setOffline(true);
  const page = await context.newPage();
  page.setDefaultTimeout(kPatience_ms);
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("console", (message) => {
    if (
      ["error", "warning"].includes(message.type()) &&
      !/GPU stall due to ReadPixels/.test(message.text())
    )
      problems.push(`console: ${message.text()}`);
  });
  const start = performance.now();
  await page.goto(pathToFileURL(resolve(report)).href);
  await page.waitForFunction(() => window.misalign !== undefined);
  return { page, context, problems, load_ms: performance.now() - start };
}
