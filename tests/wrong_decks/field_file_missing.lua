local scan = field.file{ plane = "xy" }
