# SPDX-License-Identifier: Apache-2.0
"""The suite against the device of a place; farm-run plays it. CONFORM_ARGUMENTS are those of `canopen-conform run`, CONFORM_REPORTS is the
folder for its reports."""
import os
import shlex

import pytest


@pytest.fixture(scope="module")
def power(target):
    power = target.get_driver("PowerProtocol")
    power.on()
    yield power
    power.off()


@pytest.fixture(scope="module")
def exit_code(target, power):
    reports = os.environ.get("CONFORM_REPORTS", "reports")
    code = target.get_driver("CANopenConformDriver").run(shlex.split(os.environ.get("CONFORM_ARGUMENTS", "")), reports)
    if code not in (0, 1):  # in a fixture, so that pytest says error and not failure
        pytest.fail(f"no verdict about the device: exit code {code}, see {reports}")
    return code


def test_the_device_conforms(exit_code):
    assert exit_code == 0, "requirements failed: junit.xml and report.html name them"
