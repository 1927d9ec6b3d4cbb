// The film of a deployment, played in another page.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { by, check } from "./reading.mjs";

/** The colour of a corner in a film's first frame, and the pixels that differ in its last one. */
async function frames_of(page, bytes) {
  const card = await page
    .locator(".card")
    .first()
    .evaluate((n) => getComputedStyle(n).backgroundColor);
  const cinema = await page.context().newPage(); // the report's own rules allow no film
  const frames = await cinema.evaluate(
    async (data) => {
      const video = Object.assign(document.createElement("video"), { src: data });
      const frame_at = async (time) => {
        const sought = new Promise((done) =>
          video.addEventListener("seeked", done, { once: true }),
        );
        video.currentTime = time;
        await sought;
        const [width, height] = [video.videoWidth, video.videoHeight],
          pen = Object.assign(document.createElement("canvas"), { width, height }).getContext("2d");
        pen.drawImage(video, 0, 0);
        const { data: points } = pen.getImageData(0, 0, width, height);
        let sheet = 0;
        for (let i = 0; i < points.length; i += 4)
          if ([0, 1, 2].some((k) => Math.abs(points[i + k] - points[k]) > 24)) ++sheet;
        return { corner: [...points.slice(0, 4)], sheet };
      };
      await new Promise((done) => video.addEventListener("loadeddata", done));
      return [await frame_at(0.1), await frame_at(1e6)];
    },
    `data:video/webm;base64,${bytes.toString("base64")}`,
  );
  await cinema.close();
  return frames.map((frame) => ({ ...frame, card: [...card.match(/\d+/g).map(Number), 255] }));
}

/** The reader scrolls away while it is recorded. */
export async function film_check(page, stem) {
  await check("a film shows the deployment on the ground of its card", async () => {
    await by(page, "view-files").first().click();
    await page.evaluate(() => {
      const film = document.querySelector('[data-testid="folding-film"]');
      film.addEventListener("click", () => scrollTo(0, document.body.scrollHeight), { once: true });
    });
    const [film] = await Promise.all([
      page.waitForEvent("download"),
      by(page, "folding-film").first().click(),
    ]);
    assert.equal(film.suggestedFilename(), `${stem}-deployment.webm`);
    const [first, last] = await frames_of(page, await readFile(await film.path()));
    for (const { corner } of [first, last])
      assert.ok(
        corner.every((value, i) => Math.abs(value - first.card[i]) < 8),
        `${corner} behind the sheet, not ${first.card}`,
      );
    assert.ok(last.sheet > 1.2 * first.sheet, `${first.sheet} pixels folded, ${last.sheet} flat`);
    await by(page, "view-files").first().click();
  });
}
