#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
'use strict';

// The pictures of docs/images, from the HTML report of a run. Usage: screenshots.js PAGE MODULES FOLDER
//
// MODULES is a folder in which `install` has put the npm packages.

const fs = require('node:fs');
const path = require('node:path');
const { createRequire } = require('node:module');
const { pathToFileURL } = require('node:url');

const [page_file, modules, folder] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(modules, 'package.json'))('playwright-core');
const executablePath = [process.env.CONFORM_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
    .find((file) => file && fs.existsSync(file));

// name, viewport, what is shown: a selector, or the window; `margin` around an element.
const wide = { width: 1100, height: 760 };
const pictures = [
    { name: 'report', viewport: wide },
    { name: 'report-dark', viewport: wide, colorScheme: 'dark' },
    { name: 'report-phone', viewport: { width: 450, height: 900 }, deviceScaleFactor: 0.8 },
    { name: 'report-paper', viewport: { width: 794, height: 1123 }, media: 'print' },
    { name: 'cause', viewport: wide, of: (page) => page.locator('#causes article').last() },
    { name: 'timeline', viewport: wide, of: (page) => page.locator('#causes article .lanes').last() },
    { name: 'plot', viewport: wide, of: (page) => page.locator('#measurements figure', { hasText: '1017h = 100 ms' }).first() },
];

(async () => {
    const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
    for (const { name, of, media, ...options } of pictures) {
        const context = await browser.newContext(options);
        const page = await context.newPage();
        await page.goto(pathToFileURL(path.resolve(page_file)).href);
        if (media) await page.emulateMedia({ media });
        // It would lie over what is taller than the window.
        if (of) await page.evaluate(() => { document.querySelector('header').style.position = 'static'; });
        const target = of ? of(page) : page;
        if (of) await target.scrollIntoViewIfNeeded();
        await target.screenshot({ path: path.join(folder, `${name}.png`) });
        await context.close();
    }
    await browser.close();
})();
