local steel = material.elastic("steel", 210*GPa)
