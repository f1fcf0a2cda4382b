"""Mechanisms whose forces have kinks: a cable, a slider."""

import mjcont as mc

SPRING, CABLE, SLACK = 10.0, 30.0, 0.2


def slider(tendon: str = "", actuator: str = "", joint: str = f'stiffness="{SPRING}"', site: str = "") -> mc.Mechanism:
    """A mass of 1 kg on a spring, pulled by a force F."""
    return mc.Mechanism.from_xml(
        f"""<mujoco model="slider"><option gravity="0 0 0"/><worldbody><site name="O"/>
        <body><joint name="x" type="slide" axis="1 0 0" damping="1" {joint}/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><site name="tip" pos="0.5 0 0"/></body></worldbody>
        <tendon>{tendon}</tendon><actuator><general name="F" joint="x"/>{actuator}</actuator></mujoco>"""
    )


def cable(band: str = f"0 {0.5 + SLACK}", more: str = "", stiffness: float = CABLE) -> str:
    """A cable from O to tip; by default it is slack until the mass has moved by SLACK."""
    return (
        f'<spatial name="cable" stiffness="{stiffness}" springlength="{band}" {more}>'
        '<site site="O"/><site site="tip"/></spatial>'
    )
