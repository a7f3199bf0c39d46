"""The camera, and how far off an estimate is: what all comparisons with NumPy share."""
import numpy as np


def seen(scene, light, radiance):
    """What the camera sees in a light of a radiance, a waveband by facet: facet by channel.

    A trapezoid sum over wavebands; white that faces the sun is 1 in the strongest channel.
    """
    weights = np.gradient(np.array(scene["wavelengths_nm"]))
    weights[[0, -1]] /= 2
    channels = np.array(scene["camera"]["sensitivities"]) * np.array(light["power"]) * weights
    return np.array(radiance).T @ channels.T / channels.sum(axis=1).max()


def deviations(sample):
    """Root mean square of an estimate's errors in units of their standard deviations."""
    estimate = sample["estimate"]
    error = np.array(estimate["reflectance"]) - sample["truth"]["reflectance"]
    return np.sqrt(np.mean((error / estimate["reflectance_sd"]) ** 2))
