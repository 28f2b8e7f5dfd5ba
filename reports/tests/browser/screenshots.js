#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
'use strict';

// The pictures of docs/images. Usage: screenshots.js PAGES MODULES FOLDER
//
// PAGES is a folder with report.html, dictionary.html, comparison.html and matrix.html, and with failure.ansi, what a terminal
// showed. MODULES is a folder in which `install` has put the npm packages.

const fs = require('node:fs');
const path = require('node:path');
const { createRequire } = require('node:module');
const { pathToFileURL } = require('node:url');

const [pages, modules, folder] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(modules, 'package.json'))('playwright-core');
const executablePath = [process.env.CONFORM_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
    .find((file) => file && fs.existsSync(file));

// A terminal with the inks of reports/paint.hpp.
const inks = { 1: 'font-weight: bold', 2: 'color: #8b95a1', 31: 'color: #ff8080', 32: 'color: #8fd9a5', 33: 'color: #f5c46b', 35: 'color: #c9b4ff', 36: 'color: #7fd4e0' };
function terminal(text) {
    const escaped = text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').trimEnd();
    const painted = escaped.replace(/\x1b\[([0-9;]+)m([^\x1b]*)\x1b\[0m/g,
        (_, codes, words) => `<span style="${codes.split(';').map((code) => inks[code]).join('; ')}">${words}</span>`);
    return `<!DOCTYPE html><meta charset="utf-8"><body style="margin: 0; background: #fff"><pre style="display: inline-block; margin: 0; `
        + `padding: 1rem 1.2rem; background: #11161d; color: #e6ebf1; font: 13px/1.4 'DejaVu Sans Mono', monospace">${painted}</pre>`;
}

// name, page (the report where none is named), viewport, what is shown: a selector, or the window.
const wide = { width: 1100, height: 760 };
const pictures = [
    { name: 'report', viewport: wide },
    { name: 'report-dark', viewport: wide, colorScheme: 'dark' },
    { name: 'report-phone', viewport: { width: 450, height: 900 }, deviceScaleFactor: 0.8 },
    { name: 'report-paper', viewport: { width: 794, height: 1123 }, media: 'print' },
    { name: 'cause', viewport: wide, of: (page) => page.locator('#causes article').last() },
    { name: 'timeline', viewport: wide, of: (page) => page.locator('#causes article .lanes').last() },
    { name: 'plot', viewport: wide, of: (page) => page.locator('#measurements figure', { hasText: '1017h = 100 ms' }).first() },
    { name: 'failure', page: 'failure.ansi', viewport: { width: 1200, height: 760 }, of: (page) => page.locator('pre') },
    { name: 'dictionary', page: 'dictionary.html', viewport: wide, of: (page) => page.locator('#dictionary .differs') },
    { name: 'comparison', page: 'comparison.html', viewport: wide },
    { name: 'matrix', page: 'matrix.html', viewport: { width: 1100, height: 960 }, see: '#?v=fail' },
];

(async () => {
    const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });
    for (const { name, page: file = 'report.html', of, media, see = '', ...options } of pictures) {
        const context = await browser.newContext(options);
        const page = await context.newPage();
        const place = path.resolve(pages, file);
        if (file.endsWith('.ansi')) await page.setContent(terminal(fs.readFileSync(place, 'utf8')));
        else await page.goto(pathToFileURL(place).href + see);
        if (media) await page.emulateMedia({ media });
        // It would lie over what is taller than the window.
        if (of) await page.evaluate(() => document.querySelectorAll('header').forEach((each) => { each.style.position = 'static'; }));
        const target = of ? of(page) : page;
        if (of) await target.scrollIntoViewIfNeeded();
        await target.screenshot({ path: path.join(folder, `${name}.png`) });
        await context.close();
    }
    await browser.close();
})();
