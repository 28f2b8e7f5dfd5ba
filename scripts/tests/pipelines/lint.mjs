// SPDX-License-Identifier: Apache-2.0
// lint.mjs NODE_MODULES github FILE...   what GitHub's own editor support says of workflows and of action.yml
// lint.mjs NODE_MODULES docker FILE...   what dockerfile-utils says
// lint.mjs NODE_MODULES gitlab-schema    prints the JSON schema of .gitlab-ci.yml
// The exit code is 1 when something was said.
import { readFileSync } from 'node:fs';
import { createRequire, register } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, what, ...files] = process.argv.slice(2);
const require = createRequire(join(resolve(folder), 'lint.cjs'));
register(new URL('json.mjs', import.meta.url));
const load = async name => import(pathToFileURL(name).href);
const inFolder = name => join(resolve(folder), name);
let said = 0;

function tell(file, findings) {
    for (const { range, message } of findings) {
        console.log(`${file}:${range.start.line + 1}: ${message}`);
        ++said;
    }
}

if (what === 'github') {
    const { validate } = await load(inFolder('@actions/languageservice/dist/index.js'));
    const { TextDocument } = require('vscode-languageserver-textdocument');
    for (const file of files)
        tell(file, await validate(TextDocument.create(pathToFileURL(file).href, 'yaml', 1, readFileSync(file, 'utf8'))));
} else if (what === 'docker') {
    const { validate } = require('dockerfile-utils');
    for (const file of files)
        tell(file, validate(readFileSync(file, 'utf8')));
} else {
    const { schema } = await load(inFolder('gitlab-ci-local/src/schema/schema.js'));
    console.log(JSON.stringify(schema));
}
process.exit(said > 0 ? 1 : 0);
