"""What MuJoCo's inverse dynamics say of a pose that controls are said to hold."""

import mujoco
import numpy as np


def unbalanced(mechanism, found):
    """Return the largest force that they ask for beyond the actuators', and the largest of those; at rest."""
    model = mujoco.MjModel.from_xml_string(mechanism.mjcf)
    data = mujoco.MjData(model)
    data.qpos[:] = found.state
    for name, value in found.controls.items():
        data.ctrl[model.actuator(name).id] = value
    mujoco.mj_inverse(model, data)
    mujoco.mj_fwdActuation(model, data)
    return np.abs(data.qfrc_inverse - data.qfrc_actuator).max(), np.abs(data.qfrc_actuator).max()
