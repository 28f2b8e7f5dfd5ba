// SPDX-License-Identifier: Apache-2.0
// Lets Node.js import JSON the way bundlers do, as the packages of GitHub expect.
import { readFile } from 'node:fs/promises';

export async function load(url, context, next) {
    if (!url.endsWith('.json'))
        return next(url, context);
    return { format: 'module', shortCircuit: true, source: `export default ${await readFile(new URL(url), 'utf8')}` };
}
