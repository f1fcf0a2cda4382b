"""
A truss that is shaken
======================

A small oscillating load at the apex of a truss: near the resonance there are three motions at one frequency, two of
them stable. Which one is met depends on the past, and the frequency jumps at the folds of the response.
"""

import matplotlib.pyplot as plt

import mjcont as mc

truss = mc.Mechanism.from_xml("von_mises_truss")
load = {"P": mc.Harmonic(15.0)}
response = mc.continue_response(truss, "frequency", (2.5, 5.5), load, {"joint:z.damping": 2.0})
print(response)

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
mc.plot(response, x="frequency", y="z.amplitude", ax=left, units="mm")
low, high = response.of_kind("LPC")
for point in (low, high):
    orbit = point.orbit
    right.plot(orbit["z"], orbit.rate("z", orbit.times), label=f"{point.label}, {orbit.frequency:.3f} Hz")
right.set(xlabel="z [m]", ylabel="dz/dt [m/s]")
right.legend()
