-- Units of the deck: numbers in SI, so that 20*mm is 0.02 and x / um is x in micrometres.
return {
  mm = 1e-3, um = 1e-6,
  ms = 1e-3, us = 1e-6,
  kN = 1e3,
  kPa = 1e3, MPa = 1e6, GPa = 1e9,
  Hz = 1, kHz = 1e3, MHz = 1e6,
  g0 = 9.80665,
  deg = math.pi / 180,
}
