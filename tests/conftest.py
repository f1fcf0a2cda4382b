"""Fixtures that several test files share."""

from __future__ import annotations

import signal
from functools import cache

import pytest
from problems.reference import BOUNDS, START

import mjcont as mc
from mjcont.numerics.walk import guard

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # in the background: what tests start would be deaf
    signal.signal(signal.SIGINT, signal.default_int_handler)
guard.raise_unexpected(True)  # what a user meets as a status is a failure here


@pytest.fixture
def overcentre():
    """A mechanism of its own for each test."""
    return mc.Mechanism.from_xml("overcentre")


@pytest.fixture(scope="session")
def overcentre_branch():
    """Return a function: an overcentre's branch in F for some parameter values (computed once each)."""

    @cache
    def branch(model="overcentre", **values):
        mechanism = mc.Mechanism.from_xml(model)
        return mc.continue_equilibria(mechanism, "F", bounds=BOUNDS, start={"F": START, **values})

    return branch


@pytest.fixture
def pendulum_xml():
    """Return a function: the text of an inverted pendulum of 1 kg, 1 m, with parts of the XML put in."""

    def text(*, joint="", option="", flag="", custom="", world="", body="", actuator="", sensor="", rest=""):
        return f"""
        <mujoco model="pendulum">
          <option gravity="0 0 -9.81" {option}><flag {flag}/></option>
          <custom>{custom}</custom>
          <worldbody>
            {world}
            <body name="rod">
              <joint name="hip" type="hinge" axis="0 -1 0" {joint}/>
              <inertial pos="0 0 1" mass="1" diaginertia="0.01 0.01 0.01"/>
              <site name="tip" pos="0 0 1"/>
              {body}
            </body>
          </worldbody>
          <actuator>{actuator}</actuator>
          <sensor>{sensor}</sensor>
          {rest}
        </mujoco>"""

    return text
