"""Shaft on several bearings: beam, equilibrium with the bearings, vibration.

beam         - Timoshenko elements of stepped shafts
system       - shaft, supports and loads as data
equilibrium  - displacements of shaft and bearings under the loads
heat         - temperatures of bearings that warm themselves and each other
vibration    - critical speeds, frequencies of whirl, response to unbalance
"""
