#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
'use strict';

// The pages as a reader has them: in Chromium. Usage: report_test.js SAMPLES MODULES [LARGE-PAGE [PROOF-PAGE]]
//
// SAMPLES holds run.html, comparison.html and what hostile devices make of them, MODULES is a folder in which `install`
// has put the npm packages, LARGE-PAGE has 5000 cases, PROOF-PAGE is what selftest --html wrote. Exit code 77, with the reason: there is no Chromium, or the packages are not there.

const assert = require('node:assert/strict');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const { createRequire } = require('node:module');
const { pathToFileURL } = require('node:url');

const [samples, modules, large, proof] = process.argv.slice(2);

function skip(reason) {
    console.log(`skipped: ${reason}`);
    process.exit(77);
}

const executablePath = [process.env.CONFORM_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
    .find((file) => file && fs.existsSync(file));
if (!executablePath) skip('Chromium is not installed (CONFORM_CHROMIUM names it where it is elsewhere)');
const load = createRequire(path.resolve(modules, 'package.json'));
let chromium;
let axe;
try {
    ({ chromium } = load('playwright-core'));
    axe = load('axe-core').source;
} catch {
    skip(`playwright-core and axe-core are not in ${modules}: reports/tests/browser/install ${modules}`);
}

const page_of = (name) => pathToFileURL(path.resolve(samples, name)).href;
const has_proof = proof && fs.existsSync(proof);
const proof_url = () => pathToFileURL(path.resolve(proof)).href;
// All pages of all kinds, by what to call them.
const all_pages = () => [
    ...['run.html', 'hostile.html', 'aborted.html', 'comparison.html', 'comparison-hostile.html'].map((name) => [name, page_of(name)]),
    ...(has_proof ? [['proof', proof_url()]] : []),
];
const tests = [];
const test = (name, body) => tests.push({ name, body });

// A page that is watched: it must not complain, ask for anything beside itself, or show a dialog.
async function open(browser, url, options = {}) {
    const context = await browser.newContext(options);
    const page = await context.newPage();
    const complaints = [];
    page.on('console', (message) => complaints.push(`${message.type()}: ${message.text()}`));
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('dialog', (dialog) => { complaints.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
    page.on('request', (request) => {
        if (request.url().split('#')[0] !== url.split('#')[0]) complaints.push(`request: ${request.url()}`);
    });
    await page.goto(url);
    return { page, complaints, close: () => context.close() };
}

// A page obeys its fragment in an event of its own, some time after the click that changed it.
const comes_into_view = (page, selector) => page.waitForFunction((selector) => {
    const box = document.querySelector(selector).getBoundingClientRect();
    return box.height > 0 && box.top >= 0 && box.top < window.innerHeight;
}, selector);
const visible_cases = (page) => page.locator('#cases li[data-v]:visible').count();

test('without JavaScript all is there, and nothing that would need it', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('run.html'), { javaScriptEnabled: false });
    assert.equal(await page.locator('.verdict .word').innerText(), 'Does not conform');
    assert.equal(await visible_cases(page), 7);
    assert.equal(await page.locator('#filter').isVisible(), false);
    assert.equal(await page.locator('#theme').isVisible(), false);
    await page.locator('#cases summary').first().click();
    assert.equal(await page.locator('#cases details[open] .frames').first().isVisible(), true);
    assert.deepEqual(complaints, []);
    await close();
});

test('the filter shows what was asked for and lives in the address', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('run.html'));
    await page.keyboard.press('/');
    await page.keyboard.type('1003-ERROR field-write');
    // A slow machine types in pieces, and the first of them is looked for before the last one has come.
    await page.waitForFunction(() => location.hash.endsWith('field-write'));
    assert.equal(await visible_cases(page), 1);
    assert.match(await page.locator('#shown').innerText(), /^1 of 7 cases/);
    const address = page.url();
    assert.match(address, /#\?q=1003-ERROR%20field-write$/);
    const other = await open(browser, address);
    assert.equal(await visible_cases(other.page), 1);
    assert.equal(await other.page.locator('#q').inputValue(), '1003-ERROR field-write');
    await other.close();

    await page.keyboard.press('Escape');
    assert.equal(await visible_cases(page), 7);
    await page.locator('#filter input[value=fail]').check();
    await page.locator('#filter input[value=inconclusive]').check();
    await page.waitForFunction(() => location.hash.includes('inconclusive'));
    assert.match(page.url(), /#\?v=fail,inconclusive$/);
    assert.equal(await visible_cases(page), 3);
    await page.locator('#filter button[type=reset]').click();
    await page.waitForFunction(() => !location.hash.includes('v='));
    assert.equal(await visible_cases(page), 7);
    assert.deepEqual(complaints, []);
    await close();
});

test('a link leads to its case, also to one that is filtered out or folded', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('run.html') + '#?v=pass');
    assert.equal(await visible_cases(page), 1);
    await page.locator('#summary .causes a').first().click();
    await comes_into_view(page, '#cause-1');
    await page.evaluate(() => { location.hash = '#c2'; });
    await comes_into_view(page, '#c2');
    assert.deepEqual(complaints, []);
    await close();
});

test('cards unfold by the keyboard', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('run.html'));
    const card = page.locator('#cases details').first();
    await card.locator('summary').first().focus();
    await page.keyboard.press('Enter');
    assert.equal(await card.locator('.frames').isVisible(), true);
    assert.deepEqual(complaints, []);
    await close();
});

test('light and dark follow the system until the reader says otherwise', async (browser) => {
    const background = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await open(browser, page_of('run.html'), { colorScheme: 'light' });
    const dark = await open(browser, page_of('run.html'), { colorScheme: 'dark' });
    const of_light = await background(light.page);
    const of_dark = await background(dark.page);
    assert.notEqual(of_light, of_dark);
    await light.page.locator('#theme').click();
    assert.equal(await background(light.page), of_dark);
    await dark.page.locator('#theme').click();
    assert.equal(await background(dark.page), of_light);
    await light.close();
    await dark.close();
});

test('strings of a device are shown and not obeyed', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('hostile.html'));
    assert.match(await page.locator('h1').innerText(), /^\]\]> <b>&amp;"'<\/b>/);
    assert.equal(await page.locator('main b b, main script, main style, main img').count(), 0);
    assert.deepEqual(complaints, []);
    await close();
});

test('the policy stops a script that somebody adds to the page', async (browser) => {
    const changed = path.join(fs.mkdtempSync(path.join(os.tmpdir(), 'report-')), 'changed.html');
    const text = fs.readFileSync(path.resolve(samples, 'run.html'), 'utf8');
    fs.writeFileSync(changed, text.replace('</main>', '<script>alert(1)</script><p style="color:red">x</p></main>'));
    const { complaints, close } = await open(browser, pathToFileURL(changed).href);
    assert.equal(complaints.filter((each) => each.includes('Content Security Policy')).length, 2, complaints.join('\n'));
    assert.equal(complaints.filter((each) => each.startsWith('dialog')).length, 0);
    await close();
    fs.rmSync(path.dirname(changed), { recursive: true });
});

test('paper shows what is folded, in light colours', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('run.html'), { colorScheme: 'dark' });
    const pdf = await page.pdf({ format: 'A4' });
    assert.equal(pdf.subarray(0, 5).toString(), '%PDF-');
    assert.ok(pdf.length > 50_000, `${pdf.length} bytes`);
    await page.emulateMedia({ media: 'print' });
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
    assert.equal(await page.locator('nav').isVisible(), false);
    assert.equal(await page.locator('#cases details .frames').first().isVisible(), true);
    assert.deepEqual(complaints, []);
    await close();
});

test('paper leaves out cases that have nothing to tell and says so, unless the reader has chosen', async (browser) => {
    const { page, close } = await open(browser, page_of('run.html'));
    const passed = page.locator('#cases li[data-v="pass"]:visible'), failed = page.locator('#cases li[data-v="fail"]:visible');
    const all = [await passed.count(), await failed.count()];
    assert.ok(all[0] > 0 && all[1] > 0, all.join());
    assert.equal(await page.locator('.on-paper').isVisible(), false);
    await page.emulateMedia({ media: 'print' });
    assert.deepEqual([await passed.count(), await failed.count()], [0, all[1]]);
    assert.match(await page.locator('.on-paper').innerText(), /^On paper \d+ cases? (is|are) left out/);
    await page.emulateMedia({ media: 'screen' });
    await page.locator('#filter input[value="pass"]').check();
    await page.waitForFunction(() => location.hash.includes('v=pass'));
    await page.emulateMedia({ media: 'print' });
    assert.deepEqual([await passed.count(), await failed.count()], [all[0], 0]);
    assert.equal(await page.locator('.on-paper').isVisible(), false);
    await close();
});

test('a telephone scrolls down only', async (browser) => {
    for (const [name, url] of all_pages()) {
        const { page, close } = await open(browser, url, { viewport: { width: 360, height: 800 } });
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 360, name);
        await close();
    }
});

test('axe-core finds no violation', async (browser) => {
    for (const [name, url] of all_pages()) {
        for (const colorScheme of ['light', 'dark']) {
            // Without its policy: the checker is a script of its own.
            const { page, close } = await open(browser, url, { colorScheme, bypassCSP: true });
            await page.evaluate(() => document.querySelectorAll('details').forEach((each) => { each.open = true; }));
            await page.evaluate(axe);
            const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'] }));
            assert.deepEqual(violations.map((each) => `${each.id}: ${each.nodes[0].html}`), [], `${name}, ${colorScheme}`);
            await close();
        }
    }
});

test('a comparison shows what got worse first, and all of it without JavaScript', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('comparison.html'), { javaScriptEnabled: false });
    assert.equal(await page.locator('.verdict .word').innerText(), 'Worse');
    assert.equal(await page.locator('#new-1').isVisible(), true);
    assert.equal(await page.locator('#times svg.plot').count(), 2);
    assert.equal(await page.locator('#filter').isVisible(), false);
    await page.locator('#gone-1 summary').first().click();
    assert.equal(await page.locator('#gone-1 .versus').isVisible(), true);
    assert.deepEqual(complaints, []);
    await close();
});

test('differences are filtered by their kind and by words, in the address', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('comparison.html'));
    const visible = () => page.locator('main [data-v]:visible').count();
    const all = await visible();
    await page.locator('#filter input[value=better]').check();
    await page.waitForFunction(() => location.hash.includes('v=better'));
    const better = await visible();
    assert.ok(better > 0 && better < all, `${better} of ${all}`);
    assert.equal(await page.locator('#new-1').isVisible(), false);
    await page.locator('#filter button[type=reset]').click();
    await page.waitForFunction(() => !location.hash.includes('v='));
    assert.equal(await visible(), all);
    await page.locator('#q').fill('2003h:05');
    await page.waitForFunction(() => location.hash.includes('q='));
    assert.match(await page.locator('#shown').innerText(), /1 of \d+ entries/);
    const other = await open(browser, page.url());
    assert.equal(await other.page.locator('#dictionary tr[data-v]:visible').count(), 1);
    await other.close();
    assert.deepEqual(complaints, []);
    await close();
});

test('a link of a comparison leads to its cause, also to one that is filtered out', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('comparison.html') + '#?v=better');
    assert.equal(await page.locator('#new-1').isVisible(), false);
    await page.locator('#summary .causes a').first().click();
    await comes_into_view(page, '#new-1');
    assert.deepEqual(complaints, []);
    await close();
});

test('strings of two devices are shown and not obeyed', async (browser) => {
    const { page, complaints, close } = await open(browser, page_of('comparison-hostile.html'));
    assert.equal(await page.locator('main b b, main script, main style, main img').count(), 0);
    assert.deepEqual(complaints, []);
    await close();
});

test('a proof has a row for each defect, links it to its requirements, and says what was not asked for', async (browser) => {
    if (!has_proof) return 'skipped: no page of a selftest was given';
    const { page, complaints, close } = await open(browser, proof_url());
    const rows = page.locator('#defects li[data-v]');
    const all = await rows.count();
    assert.ok(all > 0);
    // What is far below the window is not laid out yet, and has no inner text.
    const text = await rows.first().textContent();
    for (const part of ['killed', 'violates', 'killed by']) assert.ok(text.includes(part), `${part} in ${text}`);
    await rows.first().locator('.by a').first().click();
    await page.waitForFunction(() => /^#r\d+$/.test(location.hash));
    assert.match(await page.locator('#mutants').innerText(), /canopen-conform-mutants selftest --mutants/);
    const id = await rows.first().locator('b').first().textContent();
    await page.locator('#q').fill(id);
    await page.waitForFunction(() => location.hash.includes('q='));
    assert.equal(await page.locator('#defects li[data-v]:visible').count(), 1);
    assert.match(await page.locator('#shown').innerText(), new RegExp(`1 of ${all} defects?`));
    assert.deepEqual(complaints, []);
    await close();
});

test('every page prints to PDF with what is folded', async (browser) => {
    for (const [name, url] of all_pages()) {
        const { page, complaints, close } = await open(browser, url, { colorScheme: 'dark' });
        const pdf = await page.pdf({ format: 'A4' });
        assert.equal(pdf.subarray(0, 5).toString(), '%PDF-', name);
        await page.emulateMedia({ media: 'print' });
        assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)', name);
        assert.equal(await page.locator('nav').isVisible(), false, name);
        assert.deepEqual(complaints, [], name);
        await close();
    }
});

test('5000 cases open and are filtered, and it is told how long that takes', async (browser) => {
    if (!large || !fs.existsSync(large)) return 'skipped: no page of 5000 cases was given';
    const { page, complaints, close } = await open(browser, pathToFileURL(path.resolve(large)).href);
    assert.equal(await page.locator('#cases li[data-v]').count(), 5000);
    const times = await page.evaluate(() => {
        const open = performance.getEntriesByType('navigation')[0].loadEventEnd;
        const seen = performance.getEntriesByName('first-contentful-paint')[0].startTime;
        const q = document.getElementById('q');
        const filter = ['1', '12', 'non-zero', ''].map((words) => {
            const begin = performance.now();
            q.value = words;
            q.form.dispatchEvent(new Event('submit', { cancelable: true }));
            document.body.getBoundingClientRect();
            return performance.now() - begin;
        });
        return { seen, open, filter: Math.max(...filter) };
    });
    assert.deepEqual(complaints, []);
    // What is wanted is a second and a tenth of it; a machine that is busy otherwise says nothing about the page.
    await close();
    return Object.entries(times).map(([name, value]) => `${name} ${Math.round(value)} ms`).join(', ');
});

(async () => {
    const browser = await chromium.launch({
        executablePath,
        args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
            '--disable-component-update', '--disable-sync'],
    }).catch((error) => skip(`Chromium does not start: ${String(error).split('\n')[0]}`));
    let failures = 0;
    for (const { name, body } of tests) {
        try {
            const remark = await body(browser);
            console.log(`ok - ${name}${remark ? ` (${remark})` : ''}`);
        } catch (error) {
            failures += 1;
            console.log(`not ok - ${name}\n${error.stack}`);
        }
    }
    await browser.close();
    process.exit(failures ? 1 : 0);
})();
