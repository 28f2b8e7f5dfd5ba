#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
'use strict';

// A device made of the npm package `canopen`, on a SocketCAN interface. Usage: device.js INTERFACE NODE-ID [--plain]
//
// Entries are made with the methods that the package offers for them and left as those make them. The application's are
// what an error does (register, history, EMCY, in this order) and the way from outputs to inputs. Without --plain it
// also adds what many scenarios need to get any further: a boot-up message and 1017h with the length of the standard.
// Exceptions that a received frame raises are caught, written to the standard error, and counted.

const { AccessType, DataType, Device, Eds, NmtState, ObjectType } = require('canopen');
const can = require('socketcan');

const [interfaceName, nodeText, option] = process.argv.slice(2);
const node = Number(nodeText);
const helped = option !== '--plain';
const kept = { saveDefault: true };
const fixed = { saveDefault: true, accessType: AccessType.READ_ONLY };

// ---- object dictionary ----------------------------------------------------------------------------------------------

const eds = new Eds({ vendorNumber: 0x5AFE, productNumber: 0x0402, revisionNumber: 0x00010000, lssSupported: true });

const rw = (dataType, defaultValue, more = {}) =>
    ({ dataType, defaultValue, accessType: AccessType.READ_WRITE, ...more });
const as = (accessType, entry) => ({ ...entry, accessType });

function communicationEntries() {
    const deviceType = eds.getEntry(0x1000); // no device profile
    deviceType.defaultValue = deviceType.value = 0;
    eds.setIdentity({ vendorId: 0x5AFE, productCode: 0x0402, revisionNumber: 0x00010000, serialNumber: 1 });
    eds.setStatusRegister(0, kept);
    eds.setErrorHistoryLength(4, fixed);
    eds.setSyncCobId(0x80, kept);
    eds.setSyncGenerationEnable(false, kept);
    eds.setSyncCyclePeriod(100000, kept);
    eds.setSyncOverflow(0, kept);
    eds.setDeviceName('node-canopen', kept);
    eds.setHardwareVersion('none (software)', kept);
    eds.setSoftwareVersion('6.2.1', kept);
    eds.setTimeCobId(0x100, kept);
    eds.setTimeConsumerEnable(true, kept);
    eds.setEmcyCobId(0x80 + node, kept);
    eds.setEmcyInhibitTime(0, kept);
    eds.addHeartbeatConsumer(0x10, 0, kept);
    eds.addHeartbeatConsumer(0x11, 0, kept);
    if (helped)
        eds.addEntry(0x1017, { parameterName: 'Producer heartbeat time', ...rw(DataType.UNSIGNED16, 0) });
    else
        eds.setHeartbeatProducerTime(0, kept);
    eds.addEmcyConsumer(0x80 + 0x7E, kept);
    eds.addSdoServerParameter(0, 0x580 + node, 0x600 + node, { index: 0x1200, ...fixed });
    eds.addSdoServerParameter(0x7D, 0x800006C1, 0x800006C0, { index: 0x1201, ...kept }); // not valid, as the standard has it
}

function record(index, parameterName, subs) {
    eds.addEntry(index, { parameterName, objectType: ObjectType.RECORD });
    subs.forEach((sub, i) => {
        if (sub)
            eds.addSubEntry(index, i + 1, { parameterName: `${parameterName} ${i + 1}`, ...sub });
    });
    return eds.getEntry(index);
}

function manufacturerEntries() {
    const T = DataType;
    // One entry of every basic type; the sub-index is the number of the type.
    const types = [];
    for (const [type, value] of [
        [T.BOOLEAN, true], [T.INTEGER8, -2], [T.INTEGER16, -3], [T.INTEGER32, -5], [T.UNSIGNED8, 0x12],
        [T.UNSIGNED16, 0x1234], [T.UNSIGNED32, 0x12345678], [T.REAL32, 1.5], [T.VISIBLE_STRING, 'visible'],
        [T.OCTET_STRING, Buffer.from([0, 1, 0xFE, 0xFF, 0x55, 0xAA])], [T.UNICODE_STRING, 'Uni'],
        [T.TIME_OF_DAY, new Date('2024-01-01T12:00:00Z')], [T.TIME_DIFFERENCE, new Date('1984-01-02T00:00:01Z')],
        [T.INTEGER24, -4], [T.REAL64, 1.5], [T.INTEGER40, -6], [T.INTEGER48, -7], [T.INTEGER56, -8n],
        [T.INTEGER64, -9n], [T.UNSIGNED24, 0x123456], [T.UNSIGNED40, 0x123456789A], [T.UNSIGNED48, 0x123456789ABC],
        [T.UNSIGNED56, 0x123456789ABCDEn], [T.UNSIGNED64, 0x123456789ABCDEF0n],
    ])
        types[type - 1] = rw(type, value);
    record(0x2000, 'Type', types);

    record(0x2001, 'Access', [
        as(AccessType.READ_ONLY, rw(T.UNSIGNED16, 0x0102)), as(AccessType.WRITE_ONLY, rw(T.UNSIGNED16, 0)),
        rw(T.UNSIGNED16, 0x0304), as(AccessType.CONSTANT, rw(T.UNSIGNED16, 0x0506))]);
    record(0x2002, 'Limits', [
        rw(T.UNSIGNED8, 100, { lowLimit: 10, highLimit: 200 }), rw(T.INTEGER16, 0, { lowLimit: -1000, highLimit: 1000 }),
        rw(T.UNSIGNED32, 1000, { lowLimit: 100, highLimit: 1000000 }), rw(T.INTEGER8, 0, { lowLimit: -5, highLimit: 5 })]);

    // Strings of 0 to 21 characters, long ones for blocks, and a DOMAIN.
    const strings = [];
    for (let length = 0; length <= 21; ++length)
        strings.push(as(AccessType.READ_ONLY, rw(T.VISIBLE_STRING, 'abcdefghijklmnopqrstu'.slice(0, length))));
    record(0x2005, 'String', strings);
    eds.addEntry(0x2006, { parameterName: 'Writable name', ...rw(T.VISIBLE_STRING, 'writable name') });
    eds.addEntry(0x2007, { parameterName: 'Scratch value', ...rw(T.UNSIGNED32, 0) });
    eds.addEntry(0x2008, { parameterName: 'Long text', ...rw(T.OCTET_STRING, Buffer.alloc(2000, 'long text, ')) });
    eds.addEntry(0x2009, { parameterName: 'Domain', objectType: ObjectType.DOMAIN });
    eds.getEntry(0x2009).raw = Buffer.alloc(1000, 'domain, ');

    record(0x2F00, 'Error', [as(AccessType.WRITE_ONLY, rw(T.UNSIGNED16, 0)), as(AccessType.WRITE_ONLY, rw(T.UNSIGNED16, 0))]);

    const mapped = { pdoMapping: true };
    record(0x6000, 'Digital input', [1, 2].map(() => as(AccessType.READ_ONLY, rw(T.UNSIGNED8, 0, mapped))));
    record(0x6200, 'Digital output', [1, 2].map(() => rw(T.UNSIGNED8, 0, mapped)));
    eds.addEntry(0x6401, { parameterName: 'Analog input', ...as(AccessType.READ_ONLY, rw(T.INTEGER16, 0, mapped)) });
    eds.addEntry(0x6411, { parameterName: 'Analog output', ...rw(T.INTEGER16, 0, mapped) });
}

function pdos() {
    const of = (index) => eds.getEntry(index);
    eds.addReceivePdo({ cobId: 0x200 + node, transmissionType: 254, dataObjects: [of(0x6200)[1], of(0x6200)[2]] }, kept);
    eds.addReceivePdo({ cobId: 0x300 + node, transmissionType: 254, dataObjects: [of(0x6411)] }, kept);
    eds.addTransmitPdo({ cobId: 0x180 + node, transmissionType: 254, dataObjects: [of(0x6401)] }, kept);
    eds.addTransmitPdo({ cobId: 0x280 + node, transmissionType: 1, dataObjects: [of(0x6000)[1], of(0x6000)[2]] }, kept);
}

communicationEntries();
manufacturerEntries();
pdos();

// ---- application ----------------------------------------------------------------------------------------------------

const device = new Device({ id: node, eds, enableLss: true });
const active = new Set();

// CiA 301, 7.5.2.2: bits of the error register, by the upper half of the error code.
const registerBits = { 0x2: 0x02, 0x3: 0x04, 0x4: 0x08, 0x8: 0x10, 0xF: 0x80 };

function tell(code) {
    let register = active.size > 0 ? 1 : 0;
    for (const each of active)
        register |= registerBits[each >> 12] || 0;
    eds.setErrorRegister(register);
    if (code !== 0)
        eds.pushErrorHistory(code);
    if (device.state === NmtState.PRE_OPERATIONAL || device.state === NmtState.OPERATIONAL)
        device.emcy.valid && device.emcy.write(code);
}

function raise(code) {
    if (active.has(code))
        return;
    active.add(code);
    tell(code);
}

function clear(code) {
    if (active.delete(code))
        tell(0);
}

eds.getEntry(0x2F00).addListener('update', (entry) => {
    const code = entry.value;
    if (code === 0)
        return;
    if (entry.subIndex === 1)
        raise(code);
    else
        clear(code);
    entry.value = 0; // the package tells of changes only: the same code must be one the next time
});

device.nmt.addListener('timeout', () => raise(0x8130));
device.nmt.addListener('heartbeat', () => clear(0x8130));
device.pdo.addListener('pdo', () => {
    eds.getEntry(0x6000)[1].value = eds.getEntry(0x6200)[1].value;
    eds.getEntry(0x6000)[2].value = eds.getEntry(0x6200)[2].value;
    eds.getEntry(0x6401).value = eds.getEntry(0x6411).value;
});

let state = NmtState.INITIALIZING;
device.nmt.addListener('changeState', (next) => {
    if (next === NmtState.PRE_OPERATIONAL && state === NmtState.INITIALIZING) {
        active.clear();
        if (helped)
            channel.send({ id: 0x700 + node, data: Buffer.from([0]) });
    }
    state = next;
});

// ---- bus ------------------------------------------------------------------------------------------------------------

const channel = can.createRawChannel(interfaceName);
let exceptions = 0;

device.addListener('message', (message) => channel.send(message));
channel.addListener('onMessage', (message) => {
    try {
        device.receive(message);
    }
    catch (error) {
        ++exceptions;
        const frame = `${message.id.toString(16)}#${message.data.toString('hex')}${message.rtr ? 'R' : ''}`;
        const where = error.stack.split('\n').find((line) => line.includes('/canopen/source/')) || '';
        console.error(`exception at ${frame}: ${error.message} ${where.trim().replace(/.*\/canopen\/source\//, '(')}`);
    }
});
process.on('SIGTERM', () => {
    console.log(`${exceptions} exceptions`);
    process.exit(0);
});

channel.start();
device.start();
console.log(`node ${node} is on ${interfaceName}`);
