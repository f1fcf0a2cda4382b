"""A long chain of links and springs, bent by a load at its tip."""

from __future__ import annotations

import time

import mjcont as mc


def chain(links):
    """Masses and gravity are nothing; the load P acts along -z of the ground."""
    length, inside = 1.0 / links, ""
    for i in reversed(range(links)):
        end = inside or f'<site name="tip" pos="{length} 0 0"/>'
        inside = (
            f'<body pos="{length if i else 0.0} 0 0"><joint name="turn{i}" axis="0 1 0" stiffness="{links}" '
            f'damping="{0.01 * links}"/>'
            f'<geom type="capsule" fromto="0 0 0 {length} 0 0" size="{0.05 * length}" mass="{length}"/>{end}</body>'
        )
    return (
        '<mujoco model="chain"><option gravity="0 0 0"><flag contact="disable"/></option>'
        f'<worldbody><site name="ground"/>{inside}</worldbody>'
        '<actuator><general name="P" site="tip" refsite="ground" gear="0 0 -1 0 0 0"/></actuator></mujoco>'
    )


def bent(links):
    """The branch of the chain bent by up to 6 N, and the seconds of computing that a row took."""
    mechanism = mc.Mechanism.from_xml(chain(links))
    start = mc.find_equilibrium(mechanism)
    began = time.process_time()
    branch = mc.continue_equilibria(mechanism, "P", (0.0, 6.0), start, direction=1)
    return branch, (time.process_time() - began) / len(branch)
