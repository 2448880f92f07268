//! Memory behind buffers and images.

use std::sync::{Arc, Mutex, PoisonError};

use ash::vk;
use gpu_allocator::{
    AllocationError, AllocationSizes, MemoryLocation,
    vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc},
};

use crate::{GpuError, instance::Instance, owned::RawDevice};

/// The allocator of a device. Field order is destruction order: the allocator frees its blocks while the device is there.
pub(crate) struct Memory {
    allocator: Mutex<Allocator>,
    max_allocation: u64,
    _device: Arc<RawDevice>,
}

/// A piece of memory, given back on drop.
pub(crate) struct Block {
    /// Empty only during `drop`.
    allocation: Option<Allocation>,
    memory: Arc<Memory>,
}

impl Memory {
    pub(crate) fn new(
        instance: &Instance,
        device: &Arc<RawDevice>,
        physical: vk::PhysicalDevice,
        max_allocation: u64,
    ) -> Result<Arc<Self>, AllocationError> {
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.raw.clone(),
            device: device.raw.clone(),
            physical_device: physical,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: AllocationSizes::default(),
        })?;
        Ok(Arc::new(Self { allocator: Mutex::new(allocator), max_allocation, _device: Arc::clone(device) }))
    }

    /// Takes memory; `linear` for buffers.
    pub(crate) fn allocate(
        self: &Arc<Self>,
        name: &str,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Block, GpuError> {
        if requirements.size > self.max_allocation {
            let what = format!("memory of {name:?} in bytes");
            return Err(GpuError::Limit { what, value: requirements.size, limit: self.max_allocation });
        }
        let allocation_scheme = AllocationScheme::GpuAllocatorManaged;
        let desc = AllocationCreateDesc { name, requirements, location, linear, allocation_scheme };
        let mut allocator = self.allocator.lock().unwrap_or_else(PoisonError::into_inner);
        let allocation = allocator.allocate(&desc).map_err(|error| failure(name, requirements.size, error))?;
        drop(allocator);
        Ok(Block { allocation: Some(allocation), memory: Arc::clone(self) })
    }
}

fn failure(name: &str, bytes: u64, error: AllocationError) -> GpuError {
    let result = match error {
        AllocationError::OutOfMemory => return GpuError::OutOfMemory { what: format!("{name:?}"), bytes },
        AllocationError::FailedToMap(_) => vk::Result::ERROR_MEMORY_MAP_FAILED,
        AllocationError::NoCompatibleMemoryTypeFound => vk::Result::ERROR_FEATURE_NOT_PRESENT,
        _ => vk::Result::ERROR_UNKNOWN,
    };
    GpuError::Vulkan { operation: format!("allocating memory for {name:?} ({error})"), result }
}

impl Block {
    /// The memory object and the offset in it, to bind an object to.
    pub(crate) fn place(&self) -> (vk::DeviceMemory, u64) {
        let Some(allocation) = &self.allocation else { return (vk::DeviceMemory::null(), 0) };
        // SAFETY: the memory object is only bound, never freed or mapped, by our callers.
        (unsafe { allocation.memory() }, allocation.offset())
    }

    /// Where the host sees the memory, if it does without flushing.
    pub(crate) fn mapped(&self) -> Option<std::ptr::NonNull<u8>> {
        let allocation = self.allocation.as_ref()?;
        let coherent = allocation.memory_properties().contains(vk::MemoryPropertyFlags::HOST_COHERENT);
        allocation.mapped_ptr().filter(|_| coherent).map(std::ptr::NonNull::cast)
    }
}

impl Drop for Block {
    fn drop(&mut self) {
        let mut allocator = self.memory.allocator.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(Err(error)) = self.allocation.take().map(|allocation| allocator.free(allocation)) {
            tracing::error!("freeing GPU memory failed: {error}");
        }
    }
}
